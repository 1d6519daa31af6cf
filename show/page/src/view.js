// The picture: camera, surface, lines, model, section plane, picking.
import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';

/// Corners of the elements of `index` one after the other.
function gather(point, index) {
  const list = new Float32Array(3 * index.length);
  for (let i = 0; i < index.length; ++i) {
    for (let k = 0; k < 3; ++k) list[3 * i + k] = point[3 * index[i] + k];
  }
  return list;
}

function boxLines(boxes) {
  const list = [];
  for (let b = 0; b < boxes.length; b += 6) {
    const corner = (m) => [0, 1, 2].map((k) => boxes[b + k + (m & (1 << k) ? 3 : 0)]);
    for (let m = 0; m < 8; ++m) {
      for (let k = 0; k < 3; ++k) if (!(m & (1 << k))) list.push(...corner(m), ...corner(m | (1 << k)));
    }
  }
  return list;
}

// Colours are shown as the tables say, and mixed as they are.
THREE.ColorManagement.enabled = false;

export class View {
  constructor(element, data) {
    this.data = data;
    this.renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    this.renderer.setPixelRatio(window.devicePixelRatio);
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    this.renderer.setClearColor(0xffffff);
    this.renderer.localClippingEnabled = true;
    element.append(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.box = new THREE.Box3();
    for (const list of [data.point, data.model_point, data.undecided]) {
      for (let i = 0; i < (list?.length ?? 0); i += 3) {
        this.box.expandByPoint(new THREE.Vector3(list[i], list[i + 1], list[i + 2]));
      }
    }
    const size = this.box.getSize(new THREE.Vector3()).length() || 1;
    const centre = this.box.getCenter(new THREE.Vector3());
    this.camera = new THREE.PerspectiveCamera(30, 1, size / 100, size * 20);
    this.camera.up.set(0, 0, 1);
    const azimuth = (data.camera.azimuth * Math.PI) / 180;
    const elevation = (data.camera.elevation * Math.PI) / 180;
    this.camera.position.set(Math.cos(elevation) * Math.cos(azimuth),
                             Math.cos(elevation) * Math.sin(azimuth), Math.sin(elevation));
    this.camera.position.multiplyScalar(size * 2.1).add(centre);
    this.scene.add(this.camera, new THREE.AmbientLight(0xffffff, 0.5 * Math.PI));
    const lamp = new THREE.DirectionalLight(0xffffff, 0.5 * Math.PI);
    lamp.position.set(-0.3, 0.5, 1); // beside the camera, wherever that goes
    this.camera.add(lamp);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.target.copy(centre);
    this.controls.update();
    this.controls.addEventListener('change', () => this.redraw());
    this.plane = new THREE.Plane(new THREE.Vector3(-1, 0, 0), 0);
    this.materials = [];
    this.makeSurface();
    this.makeModel();
    const lines = (colour, width) => {
      const material = this.own(new LineMaterial({ color: colour, linewidth: width }));
      const object = new LineSegments2(new LineSegmentsGeometry(), material);
      object.visible = false;
      this.scene.add(object);
      return object;
    };
    this.seams = lines(0x1a1a1a, 2.2);
    this.rims = lines(0x7a7a7a, 1.4);
    this.undecided = lines(0xd62728, 1.2);
    if (data.undecided.length) this.setLines(this.undecided, boxLines(data.undecided));
    this.makeHighlight();
    window.addEventListener('resize', () => this.resize());
    this.resize();
  }

  own(material) {
    this.materials.push(material);
    return material;
  }

  makeSurface() {
    const { point, triangle } = this.data;
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(gather(point, triangle), 3));
    this.colour = new THREE.BufferAttribute(new Uint8Array(3 * triangle.length), 3, true);
    geometry.setAttribute('color', this.colour);
    this.index = new THREE.BufferAttribute(new Uint32Array(triangle.length), 1);
    geometry.setIndex(this.index);
    this.surface = new THREE.Mesh(geometry, this.own(new THREE.MeshLambertMaterial({
      vertexColors: true, flatShading: true, side: THREE.DoubleSide,
      polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 })));
    geometry.computeBoundingSphere();
    this.scene.add(this.surface);
  }

  makeModel() {
    const { model_point: point, model_triangle: triangle, model_line: line } = this.data;
    this.model = new THREE.Group();
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(point, 3));
    geometry.setIndex(new THREE.BufferAttribute(triangle, 1));
    this.model.add(new THREE.Mesh(geometry, this.own(new THREE.MeshLambertMaterial({
      color: 0x8fa3b8, transparent: true, opacity: 0.13, depthWrite: false, flatShading: true,
      side: THREE.DoubleSide }))));
    const edges = new THREE.BufferGeometry();
    edges.setAttribute('position', new THREE.BufferAttribute(point, 3));
    edges.setIndex(new THREE.BufferAttribute(line, 1));
    this.model.add(new THREE.LineSegments(edges, this.own(new THREE.LineBasicMaterial({
      color: 0x5a6b7c, transparent: true, opacity: 0.55 }))));
    this.scene.add(this.model);
  }

  makeHighlight() {
    this.highlight = new THREE.Group();
    this.scene.add(this.highlight);
  }

  /// Elements as marks over everything else: flat lists of corners.
  mark({ triangles = [], lines = [], points = [] }) {
    for (const child of this.highlight.children) child.geometry.dispose();
    this.highlight.clear();
    const add = (Type, material, list) => {
      if (!list.length) return;
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute('position', new THREE.Float32BufferAttribute(list, 3));
      const object = new Type(geometry, material);
      object.renderOrder = 1;
      this.highlight.add(object);
    };
    const style = { color: 0xff5a1f, transparent: true, depthTest: false };
    add(THREE.Mesh, new THREE.MeshBasicMaterial({ ...style, opacity: 0.45, side: THREE.DoubleSide }), triangles);
    add(THREE.LineSegments, new THREE.LineBasicMaterial(style), lines);
    add(THREE.Points, new THREE.PointsMaterial({ ...style, size: 9, sizeAttenuation: false }), points);
    this.redraw();
  }

  setVisible(numbers, count) {
    for (let i = 0; i < count; ++i) {
      for (let k = 0; k < 3; ++k) this.index.array[3 * i + k] = 3 * numbers[i] + k;
    }
    this.index.needsUpdate = true;
    this.surface.geometry.setDrawRange(0, 3 * count);
    this.redraw();
  }

  /// `colourOf(triangle, corner)` gives three bytes.
  setColours(colourOf) {
    for (let c = 0; c < this.data.triangle.length; ++c) {
      this.colour.array.set(colourOf(Math.floor(c / 3), this.data.triangle[c]), 3 * c);
    }
    this.colour.needsUpdate = true;
    this.redraw();
  }

  setLines(object, corners) {
    object.geometry.dispose();
    object.geometry = new LineSegmentsGeometry();
    object.hasLines = corners.length > 0;
    if (object.hasLines) object.geometry.setPositions(corners);
    object.visible = object.hasLines && object.wanted !== false;
    this.redraw();
  }
  show(object, wanted) {
    object.wanted = wanted;
    object.visible = wanted && object.hasLines !== false;
    this.redraw();
  }
  lineCorners(numbers) {
    return gather(this.data.point, numbers.flatMap((i) => [this.data.line[2 * i], this.data.line[2 * i + 1]]));
  }

  /// axis: 0, 1, 2 or -1 for none; t: where, from 0 to 1.
  setSection(axis, t, flip) {
    if (axis >= 0) {
      const lo = this.box.min.getComponent(axis);
      const hi = this.box.max.getComponent(axis);
      const sign = flip ? 1 : -1;
      this.plane.normal.set(0, 0, 0).setComponent(axis, sign);
      this.plane.constant = -sign * (lo + t * (hi - lo));
    }
    this.section = axis >= 0;
    for (const material of this.materials) {
      material.clippingPlanes = axis >= 0 ? [this.plane] : [];
      material.needsUpdate = true;
    }
    this.redraw();
  }

  /// The visible triangle at a pixel of the window, and the point of it.
  pick(x, y) {
    if (!this.surface.visible) return null;
    const r = this.renderer.domElement.getBoundingClientRect();
    const at = new THREE.Vector2(((x - r.left) / r.width) * 2 - 1, 1 - ((y - r.top) / r.height) * 2);
    const ray = new THREE.Raycaster();
    ray.setFromCamera(at, this.camera);
    const hit = ray.intersectObject(this.surface)
        .find((h) => !this.section || this.plane.distanceToPoint(h.point) >= 0);
    return hit ? { triangle: Math.floor(hit.face.a / 3), point: hit.point } : null;
  }

  resize() {
    this.renderer.setSize(window.innerWidth, window.innerHeight);
    this.camera.aspect = window.innerWidth / window.innerHeight;
    this.camera.updateProjectionMatrix();
    this.redraw();
  }
  redraw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.renderer.render(this.scene, this.camera);
    });
  }
}
