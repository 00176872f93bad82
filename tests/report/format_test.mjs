// Numbers of a waterfall add up as they are shown.
import assert from 'node:assert/strict';
import { decimalsThatAddUp, fixed } from '../../report/web/src/format.js';

assert.equal(decimalsThatAddUp([48.3152, -11.5258], 36.7894, 2), 2);
// 45.08 - 11.98 = 33.10, but the sum is 33.09: one decimal less, 45.1 - 12.0 = 33.1.
const parts = [45.0764, -11.9835];
assert.equal(decimalsThatAddUp(parts, 33.0929, 2), 1);
assert.deepEqual([...parts, 33.0929].map((value) => fixed(value, 1)), ['45.1', '\u221212.0', '33.1']);
// Where no decimals do, they stay.
assert.equal(decimalsThatAddUp([0.4, 0.4, 0.4], 1.2, 0), 0);
