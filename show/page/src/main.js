// Wires the controls of the page to the picture.
import { Colours, rangeOf } from './colours.js';
import { readData } from './data.js';
import { Nested } from './nested.js';
import { describe, marks } from './picked.js';
import { View } from './view.js';

const $ = (id) => document.getElementById(id);
const number = (v) => (Number.isFinite(v) ? String(Number(v.toPrecision(5))) : '–');

function fillTable(table, rows) {
  table.replaceChildren(...rows.map(([name, value]) => {
    const row = document.createElement('tr');
    for (const text of [name, value]) row.append(Object.assign(document.createElement('td'), { textContent: text }));
    return row;
  }));
}

function start() {
  const data = readData();
  document.title = `${data.title} – Blum`;
  $('title').textContent = data.title;
  fillTable($('facts'), data.facts);
  const view = new View($('scene'), data);
  const nested = new Nested(data);
  const colours = new Colours(data.colours);

  const hide = (id, when) => { $(id).hidden = when; };
  hide('theta-part', !data.triangle_theta);
  hide('show-model-label', !data.model_triangle.length);
  hide('show-undecided-label', !data.undecided.length);
  for (const label of document.querySelectorAll('.of-lines')) label.hidden = !data.line.length;
  if (!data.triangle_edge) {
    hide('sheets-row', true);
    $('surface-name').textContent = 'surface';
  }

  const showTheta = () => {
    const theta = Number($('theta').value);
    $('theta-value').textContent = theta;
    nested.choose(theta);
    view.setVisible(nested.visible, nested.count);
    const { seams, rims } = nested.lines();
    view.setLines(view.seams, view.lineCorners(seams));
    view.setLines(view.rims, view.lineCorners(rims));
    $('triangles').textContent = nested.count;
    $('sheets').textContent = nested.sheets() ?? '';
  };
  $('theta').addEventListener('input', showTheta);

  data.fields.forEach((field, i) => $('colour').append(new Option(field.name, i)));
  const showColour = () => {
    const i = Number($('colour').value || 0);
    const field = data.fields[i];
    if (!field) return;
    const values = data[`field_${i}`];
    const [least, most] = rangeOf(field, values);
    view.setColours((t, p) => {
      const v = values[field.perTriangle ? t : p];
      if (field.isLabel) return colours.ofLabel(v);
      return colours.of((v - least) / (most - least || 1));
    });
    $('legend').style.background = colours.gradient();
    hide('legend', field.isLabel);
    $('least').textContent = field.isLabel ? `one colour for each ${field.name}` : number(least);
    $('most').textContent = field.isLabel ? '' : number(most) + (field.name === 'angle' ? '°' : '');
  };
  $('colour').addEventListener('change', showColour);

  const switches = { model: view.model, sheets: view.surface, seams: view.seams, rims: view.rims, undecided: view.undecided };
  for (const [name, object] of Object.entries(switches)) {
    $(`show-${name}`).addEventListener('change', (event) => view.show(object, event.target.checked));
  }

  const showSection = () => view.setSection('xyz'.indexOf($('section-axis').value || '-'),
                                            Number($('section').value), $('section-flip').checked);
  for (const id of ['section', 'section-axis', 'section-flip']) $(id).addEventListener('input', showSection);

  let down = null;
  const canvas = view.renderer.domElement;
  canvas.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; });
  canvas.addEventListener('pointerup', (event) => {
    if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
    const hit = view.pick(event.clientX, event.clientY);
    $('picked').hidden = !hit;
    view.mark(hit ? marks(data, hit.triangle) : {});
    if (!hit) return;
    $('picked-title').textContent = `Triangle ${hit.triangle}`;
    fillTable($('picked-facts'), describe(data, hit, number));
  });

  showColour();
  showTheta();
  showSection();
  document.body.dataset.ready = 'yes';
}

try {
  start();
} catch (error) {
  $('problem').hidden = false;
  $('problem').textContent = `This page needs WebGL: ${error.message}`;
  console.error(error);
}
