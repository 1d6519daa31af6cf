// Bundles src/ with three.js into the one file that the tool embeds: `npm ci && npm run build`.
import { readFile, writeFile } from 'node:fs/promises';
import { build } from 'esbuild';

const bundle = await build({
  entryPoints: ['src/main.js'],
  bundle: true,
  minify: true,
  format: 'iife',
  target: 'es2020',
  legalComments: 'inline',
  charset: 'utf8',
  write: false,
});
const script = bundle.outputFiles[0].text;
if (script.includes('</script')) throw new Error('the bundle would end its own element');
const page = await readFile('src/page.html', 'utf8');
// A function as replacement: "$" in the script means nothing then.
await writeFile('page.html', page.replace('<!-- blum:script -->', () => `<script>${script}</script>`));
console.log(`page.html: ${(script.length / 1024).toFixed(0)} KiB of script`);
