// The nested sequence of simplified axes: cells whose value is at least theta, and its sheets.

export class Nested {
  constructor(data) {
    this.data = data;
    this.triangles = data.triangle.length / 3;
    this.edges = 0;
    for (const e of data.triangle_edge ?? []) this.edges = Math.max(this.edges, e + 1);
    for (const e of data.line_edge ?? []) this.edges = Math.max(this.edges, e + 1);
    this.degree = new Uint32Array(this.edges);
    this.visible = new Uint32Array(this.triangles);
  }

  /// Sets `visible` (numbers of triangles, `count` of them) and `degree` (visible triangles at an edge).
  choose(theta) {
    const { triangle_theta: value, triangle_edge: edge } = this.data;
    this.count = 0;
    for (let t = 0; t < this.triangles; ++t) {
      if (!value || value[t] >= theta) this.visible[this.count++] = t;
    }
    this.theta = theta;
    if (!edge) return;
    this.degree.fill(0);
    for (let i = 0; i < this.count; ++i) {
      for (let k = 0; k < 3; ++k) ++this.degree[edge[3 * this.visible[i] + k]];
    }
  }

  /// Maximal pieces of visible triangles joined across edges that two of them share.
  sheets() {
    const edge = this.data.triangle_edge;
    if (!edge) return null;
    const parent = new Uint32Array(this.triangles);
    for (let t = 0; t < this.triangles; ++t) parent[t] = t;
    const root = (t) => {
      while (parent[t] !== t) t = parent[t] = parent[parent[t]];
      return t;
    };
    const first = new Int32Array(this.edges).fill(-1);
    let sheets = this.count;
    for (let i = 0; i < this.count; ++i) {
      const t = this.visible[i];
      for (let k = 0; k < 3; ++k) {
        const e = edge[3 * t + k];
        if (this.degree[e] !== 2) continue;
        if (first[e] < 0) {
          first[e] = t;
          continue;
        }
        const a = root(first[e]);
        const b = root(t);
        if (a === b) continue;
        parent[a] = b;
        --sheets;
      }
    }
    return sheets;
  }

  /// Numbers of the lines that are seams (or bare curves) and rims of what is visible.
  lines() {
    const { line, line_theta: value, line_edge: edge, line_seam: seam } = this.data;
    const seams = [];
    const rims = [];
    for (let i = 0; i < line.length / 2; ++i) {
      if (value && !(value[i] >= this.theta)) continue;
      const degree = edge ? this.degree[edge[i]] : seam[i] >= 0 ? 3 : 1;
      if (degree === 1) rims.push(i);
      else if (degree !== 2) seams.push(i);
    }
    return { seams, rims };
  }
}
