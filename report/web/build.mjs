// Makes the page: one HTML file with scripts, styles and licenses in it.
// node build.mjs <page.html> <app.html>: the page of --html, and that of rollrig serve
import { build } from 'esbuild';
import { createHash } from 'node:crypto';
import { readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import temml from 'temml';

const here = dirname(fileURLToPath(import.meta.url));
const [pageFile, appFile] = process.argv.slice(2);
const read = (...path) => readFileSync(join(here, ...path), 'utf8');

/// Equations as MathML, which browsers draw without a library: equations.json has their TeX.
const typesetEquations = {
  name: 'equations',
  setup: ({ onLoad }) => onLoad({ filter: /equations\.json$/ }, ({ path }) => {
    const typeset = ({ tex, text }) => ({ mathml: temml.renderToString(tex, { displayMode: true, xml: true, strict: true, throwOnError: true }), text });
    const all = JSON.parse(readFileSync(path, 'utf8'));
    return { contents: JSON.stringify(Object.fromEntries(Object.entries(all).map(([name, list]) => [name, list.map(typeset)]))), loader: 'json' };
  }),
};

async function bundle(entry) {
  const result = await build({
    entryPoints: [join(here, entry)],
    bundle: true,
    minify: true,
    write: false,
    format: 'iife',
    target: 'es2020',
    charset: 'utf8',
    plugins: [typesetEquations],
    legalComments: 'none', // the licenses stand in the page in full
    define: { 'process.env.NODE_ENV': '"production"' },
  });
  return result.outputFiles[0].text;
}

/// What the licenses of the bundled packages ask to be handed on.
function collectLicenses() {
  const parts = [];
  for (const [name, files] of [
    ['echarts', ['LICENSE', 'NOTICE']],
    ['zrender', ['LICENSE']],
    ['tslib', ['LICENSE.txt']],
  ]) {
    const { version, license } = JSON.parse(read('node_modules', name, 'package.json'));
    parts.push(`${name} ${version} (${license})\n`);
    for (const file of files) parts.push(read('node_modules', name, file).trim() + '\n');
  }
  return parts.join('\n');
}

const escapeScript = (text) => text.replaceAll('</script', '<\\/script').replaceAll('<!--', '<\\!--');
const escapeHtml = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;');

function fill(text, name, value) {
  if (!text.includes(`/*${name}*/`)) throw new Error(`the template has no place for ${name}`);
  return text.replace(`/*${name}*/`, () => value);
}

async function make(template, entry, styles) {
  const style = (await Promise.all(styles.map(bundle))).join('');
  const script = escapeScript(await bundle(entry));
  let html = fill(read(template), 'STYLE', style);
  html = fill(html, 'SCRIPT', script);
  // The page's policy allows this one script, and no handler in an attribute.
  html = fill(html, 'SCRIPT_HASH', `sha256-${createHash('sha256').update(script).digest('base64')}`);
  return fill(html, 'LICENSES', escapeHtml(collectLicenses()));
}

writeFileSync(pageFile, await make('template.html', 'src/main.js', ['style.css']));
writeFileSync(appFile, await make('serve_template.html', 'src/serve/serve.js', ['style.css', 'serve.css']));
