// What is said and marked of a picked triangle.

/// Sites are numbered vertices, edges, triangles of the model.
export function site(data, id) {
  const [vertices, edges] = data.siteCounts;
  if (id < 0) return null;
  if (id < vertices) return { kind: 'vertex', number: id };
  if (id < vertices + edges) return { kind: 'edge', number: id - vertices };
  return { kind: 'face', number: id - vertices - edges };
}
function nameOf(data, id) {
  const s = site(data, id);
  return s ? `${s.kind} ${s.number}` : '–';
}

function corner(data, p) {
  return [data.point[3 * p], data.point[3 * p + 1], data.point[3 * p + 2]];
}
function cross([a, b, c], [d, e, f]) {
  return [b * f - c * e, c * d - a * f, a * e - b * d];
}
const minus = (a, b) => a.map((v, k) => v - b[k]);

/// Weights of the three corners at a point of their plane.
export function weights(a, b, c, p) {
  const area = (u, v) => Math.hypot(...cross(u, v));
  const w = [area(minus(b, p), minus(c, p)), area(minus(c, p), minus(a, p)), area(minus(a, p), minus(b, p))];
  const sum = w[0] + w[1] + w[2];
  return sum > 0 ? w.map((v) => v / sum) : [1, 0, 0];
}

export function describe(data, { triangle: t, point }, number) {
  const at = [point.x, point.y, point.z];
  const corners = [0, 1, 2].map((k) => data.triangle[3 * t + k]);
  const weight = weights(...corners.map((p) => corner(data, p)), at);
  const rows = [['at', at.map((v, k) => number(v * data.unit + data.origin[k])).join(', ')]];
  data.fields.forEach((field, i) => {
    const values = data[`field_${i}`];
    if (field.name === 'angle') return;
    const value = field.perTriangle ? values[t] : corners.reduce((sum, p, k) => sum + weight[k] * values[p], 0);
    rows.push([field.name, number(value)]);
  });
  if (data.triangle_angle) {
    rows.push(['angle', `${number(data.triangle_angle[2 * t])}° to ${number(data.triangle_angle[2 * t + 1])}°`]);
  }
  if (data.triangle_theta) {
    const value = data.triangle_theta[t];
    rows.push(['stays up to', value > 180 ? 'any θ' : `θ = ${number(value)}°`]);
  }
  if (data.triangle_governor) {
    rows.push(['governors', [0, 1].map((k) => nameOf(data, data.triangle_governor[2 * t + k])).join(', ')]);
  }
  if (data.governor_begin && data.radius) {
    const p = corners[weight.indexOf(Math.max(...weight))];
    const list = [...data.governor.slice(data.governor_begin[p], data.governor_begin[p + 1])];
    rows.push(['nearest vertex', `${p}${data.on_axis?.[p] ? ', on the axis' : ''}`],
              ['its radius', number(data.radius[p])],
              ['its governors', list.map((id) => nameOf(data, id)).join(', ')]);
  }
  return rows;
}

/// The triangle, and its governors on the model.
export function marks(data, t) {
  const result = { triangles: [], lines: [], points: [] };
  for (let k = 0; k < 3; ++k) result.triangles.push(...corner(data, data.triangle[3 * t + k]));
  const model = (p) => data.model_point.slice(3 * p, 3 * p + 3);
  for (let k = 0; k < 2 && data.triangle_governor; ++k) {
    const s = site(data, data.triangle_governor[2 * t + k]);
    if (s?.kind === 'vertex') result.points.push(...model(s.number));
    if (s?.kind === 'edge') for (let i = 0; i < 2; ++i) result.lines.push(...model(data.model_edge[2 * s.number + i]));
    if (s?.kind === 'face') for (let i = 0; i < 3; ++i) result.triangles.push(...model(data.model_triangle[3 * s.number + i]));
  }
  return result;
}
