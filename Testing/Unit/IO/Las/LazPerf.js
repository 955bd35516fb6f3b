// node LazPerf.js IN.laz OUT: unpacks a LAZ file with laz-perf, a decoder that is not ours, and writes its point
// records. Ends with 77 where the npm package laz-perf is not installed.
'use strict';
const fs = require('fs');

let createLazPerf;
try {
  ({ createLazPerf } = require('laz-perf'));
} catch (fault) {
  process.exit(77);
}

createLazPerf().then((perf) => {
  const bytes = fs.readFileSync(process.argv[2]);
  const at = perf._malloc(bytes.length);
  perf.HEAPU8.set(bytes, at);
  const file = new perf.LASZip();
  file.open(at, bytes.length);
  const length = file.getPointLength();
  const records = Buffer.alloc(file.getCount() * length);
  const record = perf._malloc(length);
  for (let i = 0; i < file.getCount(); ++i) {
    file.getPoint(record);
    records.set(perf.HEAPU8.subarray(record, record + length), i * length);
  }
  fs.writeFileSync(process.argv[3], records);
});
