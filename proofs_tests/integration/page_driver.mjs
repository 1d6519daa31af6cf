// Drives a page of `blum view` in headless Chromium: page_driver.mjs PLAYWRIGHT CHROMIUM PAGE.html THETA...
// Prints what it has seen as JSON. page.py says what that has to be.
import { pathToFileURL } from 'node:url';

const [playwright, chromium, file, ...thetas] = process.argv.slice(2);
const { chromium: browserType } = await import(pathToFileURL(playwright).href);
const browser = await browserType.launch({
  executablePath: chromium,
  // WebGL in software: the machine need not have a GPU. As root Chromium has no sandbox.
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage'],
});
const seen = { problems: [], requests: [], sheets: {}, triangles: {}, times: {} };
try {
  const page = await browser.newPage({ viewport: { width: 900, height: 640 } });
  page.on('console', (m) => { if (m.type() === 'error') seen.problems.push(m.text()); });
  page.on('pageerror', (e) => seen.problems.push(String(e)));
  page.on('request', (r) => { if (!r.url().startsWith('data:')) seen.requests.push(r.url()); });
  const begin = Date.now();
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector('body[data-ready=yes]', { timeout: 60000 });
  seen.times.ready_ms = Date.now() - begin;

  /// Pixels of the picture that are not white, and how many colours.
  const look = () => page.evaluate(async () => {
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const from = document.querySelector('#scene canvas');
    const to = Object.assign(document.createElement('canvas'), { width: from.width, height: from.height });
    const context = to.getContext('2d');
    context.drawImage(from, 0, 0);
    const data = context.getImageData(0, 0, to.width, to.height).data;
    let covered = 0;
    let sum = 0;
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) {
      const colour = data[i] << 16 | data[i + 1] << 8 | data[i + 2];
      colours.add(colour);
      if (colour !== 0xffffff) ++covered;
      sum = (sum * 31 + colour) % 2147483647;
    }
    return { covered: covered / (data.length / 4), colours: colours.size, sum };
  });
  const set = (id, value) => page.evaluate(([id, value]) => {
    const element = document.getElementById(id);
    if (element.type === 'checkbox') element.checked = value;
    else element.value = value;
    const begin = performance.now();
    element.dispatchEvent(new Event('input', { bubbles: true }));
    element.dispatchEvent(new Event('change', { bubbles: true }));
    return performance.now() - begin;
  }, [id, value]);

  seen.first = await look();
  for (const theta of thetas) {
    const ms = await set('theta', theta);
    seen.times.slider_ms = Math.max(seen.times.slider_ms ?? 0, ms);
    seen.sheets[theta] = await page.textContent('#sheets');
    seen.triangles[theta] = await page.textContent('#triangles');
  }
  await set('theta', 0);

  // Somewhere around the middle there is a sheet.
  for (const [x, y] of [[450, 320], [480, 340], [420, 330], [500, 300], [450, 360]]) {
    await page.mouse.click(x, y);
    if (await page.isVisible('#picked')) break;
  }
  seen.picked = { title: await page.textContent('#picked-title'),
                  facts: await page.$$eval('#picked-facts tr', (rows) => Object.fromEntries(
                      rows.map((row) => [row.cells[0].textContent, row.cells[1].textContent]))) };
  await page.mouse.click(890, 630);
  seen.pickedBackground = await page.isVisible('#picked');

  seen.changed = {};
  let before = await look();
  const undecided = await page.isVisible('#show-undecided-label');
  for (const [name, id, value] of [...(undecided ? [['undecided', 'show-undecided', false]] : []),
                                   ['angle', 'colour', '1'], ['sheet', 'colour', '2'],
                                   ['section', 'section-axis', 'x'], ['model', 'show-model', false],
                                   ['rims', 'show-rims', false], ['seams', 'show-seams', false],
                                   ['sheets', 'show-sheets', false]]) {
    await set(id, value);
    const now = await look();
    seen.changed[name] = now.sum !== before.sum;
    before = now;
  }
  seen.last = before;
} finally {
  await browser.close();
}
console.log(JSON.stringify(seen));
