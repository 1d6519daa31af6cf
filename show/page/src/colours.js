// Colours of numbers: the tables are the tool's, so that page and `blum render` agree.

const grey = [128, 128, 128];

export class Colours {
  constructor({ map, labels }) {
    this.map = map;
    this.labels = labels;
  }
  /// t in [0, 1] to three bytes; grey where that is no number.
  of(t) {
    if (!Number.isFinite(t)) return grey;
    const x = Math.min(Math.max(t, 0), 1) * (this.map.length - 1);
    const k = Math.min(Math.floor(x), this.map.length - 2);
    return this.map[k].map((c, i) => Math.round(c + (x - k) * (this.map[k + 1][i] - c)));
  }
  ofLabel(n) {
    return n >= 0 && Number.isFinite(n) ? this.labels[Math.floor(n) % this.labels.length] : grey;
  }
  gradient() {
    return `linear-gradient(to right, ${this.map.map((c) => `rgb(${c})`).join(', ')})`;
  }
}

/// Range of the finite values of a field; angles always 0 to 180.
export function rangeOf(field, values) {
  if (field.name === 'angle') return [0, 180];
  let least = Infinity;
  let most = -Infinity;
  for (const v of values) {
    if (!Number.isFinite(v)) continue;
    if (v < least) least = v;
    if (v > most) most = v;
  }
  return least <= most ? [least, most] : [0, 1];
}
