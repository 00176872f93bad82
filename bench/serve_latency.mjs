// From a moved slider to the picture: an ISO 28580 run of the tire a50 on the page of rollrig serve, in headless
// Chromium, with a slider that is dragged with the mouse for half a minute. Prints the median and the 95th percentile;
// exit status 1 above 100 ms.
// node bench/serve_latency.mjs [rollrig]
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { quantile, ServePage, startServer, wait } from '../tests/serve/serve_page.mjs';

const kMost_ms = 100;
const folder = mkdtempSync(join(tmpdir(), 'rollrig-latency-'));
const server = await startServer(process.argv[2] || 'rollrig', [], folder);
const page = new ServePage();
await page.open(server.address);
await wait(500);
await page.evaluate('window.rollrig.latencies.length = 0');
for (const key of ['pressure_kPa', 'load_N', 'speed_km_h', 'ambient_degC']) {
  const path = Array.from({ length: 60 }, (_, i) => 0.5 + 0.4 * Math.sin((2 * Math.PI * i) / 60));
  await page.drag(`#setting-${key}`, path, 120);
  await wait(300);
}
const latencies = await page.evaluate('window.rollrig.latencies');
const high_ms = quantile(latencies, 0.95);
console.log(`${latencies.length} positions: median ${quantile(latencies, 0.5).toFixed(0)} ms, 95th percentile ${high_ms.toFixed(0)} ms, longest ${Math.max(...latencies).toFixed(0)} ms`);
await page.close();
await server.end();
rmSync(folder, { recursive: true });
process.exit(high_ms <= kMost_ms ? 0 : 1);
