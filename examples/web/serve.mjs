// SPDX-License-Identifier: Apache-2.0
// usage: serve.mjs FOLDER [PORT [plain]]
// Serves static files on the loopback interface, and prints the address. The server sends the headers that allow pages
// to share memory with workers. With `plain`, the server omits these headers, as most servers do.

import {createReadStream} from 'node:fs';
import {stat} from 'node:fs/promises';
import {createServer} from 'node:http';
import {extname, join, normalize} from 'node:path';

const [folder, port = '8080', plain] = process.argv.slice(2);
if (!folder) {
  console.error('usage: serve.mjs FOLDER [PORT [plain]]');
  process.exit(2);
}

const TYPES = {
  '.css': 'text/css', '.html': 'text/html', '.js': 'text/javascript', '.json': 'application/json', '.png': 'image/png',
  '.jpg': 'image/jpeg'
};
const ISOLATION = {
  'Cross-Origin-Opener-Policy': 'same-origin',
  'Cross-Origin-Embedder-Policy': 'require-corp'
};

const server = createServer(async (request, response) => {
  try {
    const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
    const file = join(folder, normalize(path.endsWith('/') ? `${path}index.html` : path));
    const {size} = await stat(file);
    response.writeHead(200, {
      'Content-Type': TYPES[extname(file)] ?? 'application/octet-stream',
      'Content-Length': size,
      'Cache-Control': 'no-cache',
      ...(plain ? {} : ISOLATION)
    });
    createReadStream(file).pipe(response);
  } catch {
    response.writeHead(404, {'Content-Type': 'text/plain'}).end('There is no such file.\n');
  }
});
server.listen(Number(port), '127.0.0.1', () => {
  console.log(`http://localhost:${server.address().port}/`);
});
