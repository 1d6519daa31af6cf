// The data that `blum view` has put into the page.

const types = { f32: Float32Array, f64: Float64Array, u32: Uint32Array, i32: Int32Array, u8: Uint8Array };

function bytes(base64) {
  const text = atob(base64);
  const result = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) result[i] = text.charCodeAt(i);
  return result;
}

export function readData() {
  const header = JSON.parse(document.getElementById('blum-header').textContent);
  const array = {};
  for (const [name, type] of Object.entries(header.arrays)) {
    const element = document.getElementById('blum-' + name);
    array[name] = new types[type](bytes(element.textContent.trim()).buffer);
    element.remove(); // text of megabytes that nobody needs again
  }
  return { ...header, ...array };
}
