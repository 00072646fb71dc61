// See scripts/compare_three, which runs this beside the packages that it needs.
import { execFileSync } from 'node:child_process';
import { createServer } from 'node:http';
import { mkdirSync, readFileSync } from 'node:fs';
import { dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import puppeteer from 'puppeteer-core';

const here = dirname(fileURLToPath(import.meta.url));
const [scenes, mesher] = process.argv.slice(2);
const models = [
  'DamagedHelmet.glb', 'FlightHelmet/FlightHelmet.gltf', 'BoxVertexColors.glb', 'CesiumMan.glb',
  'greySnapper_vertColor.glb', 'SunglassesKhronos.glb', 'oaktree.gltf', 'ExplodingBarrel.glb',
  'Fox.glb', 'chr_knight.glb', 'samplebuilding.gltf', 'terrain.glb',
];
const size = { width: 800, height: 600 };
const leastPsnr = 30;

const page = `<!doctype html><script type="importmap">
{"imports": {"three": "/three/build/three.module.js", "addons/": "/three/examples/jsm/"}}
</script><script type="module">
import * as THREE from 'three';
import { GLTFLoader } from 'addons/loaders/GLTFLoader.js';
import { MeshoptDecoder } from 'addons/libs/meshopt_decoder.module.js';

// Only what a base color is made of.
function baseColor(material) {
  return new THREE.MeshBasicMaterial({
    map: material.map, color: material.color, vertexColors: material.vertexColors,
    side: material.side, transparent: material.transparent, opacity: material.opacity,
    alphaTest: material.alphaTest, depthWrite: material.depthWrite });
}

async function pixelsOfThree(url, view, size) {
  const renderer = new THREE.WebGLRenderer({ antialias: true, alpha: true });
  renderer.setSize(size.width, size.height, false);
  renderer.toneMapping = THREE.NoToneMapping;
  renderer.setClearColor(0, 0);
  const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
  const scene = (await loader.loadAsync(url)).scene;
  scene.traverse((node) => { if (node.isMesh) node.material = baseColor(node.material); });
  const [cosPitch, sinPitch] = [Math.cos(view.pitch_rad), Math.sin(view.pitch_rad)];
  const back = new THREE.Vector3(
    Math.sin(view.yaw_rad) * cosPitch, sinPitch, Math.cos(view.yaw_rad) * cosPitch);
  const camera = new THREE.PerspectiveCamera(
    35, size.width / size.height, view.distance / 100, view.distance * 100);
  const pivot = new THREE.Vector3(...view.pivot);
  camera.position.copy(pivot).addScaledVector(back, view.distance);
  camera.lookAt(pivot);
  renderer.render(scene, camera);
  const gl = renderer.getContext();
  const bytes = new Uint8Array(4 * size.width * size.height);
  gl.readPixels(0, 0, size.width, size.height, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
  renderer.dispose();
  return bytes;
}

async function pixelsOfPicture(url, size) {
  const image = new Image();
  image.src = url;
  await image.decode();
  const canvas = new OffscreenCanvas(size.width, size.height);
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, size.width, size.height).data;
}

// Rows of WebGL count from the bottom.
window.compare = async (model, picture, view, size) => {
  const [three, ours] = [await pixelsOfThree(model, view, size), await pixelsOfPicture(picture, size)];
  let [both, either, squares] = [0, 0, 0];
  for (let y = 0; y < size.height; ++y) {
    for (let x = 0; x < size.width; ++x) {
      const a = 4 * ((size.height - 1 - y) * size.width + x);
      const b = 4 * (y * size.width + x);
      if (three[a + 3] > 0 || ours[b + 3] > 0) ++either;
      if (three[a + 3] < 255 || ours[b + 3] < 255) continue;
      ++both;
      for (let c = 0; c < 3; ++c) squares += (three[a + c] - ours[b + c]) ** 2;
    }
  }
  return { both, either, psnr: 10 * Math.log10(255 ** 2 / Math.max(squares / (3 * both), 1e-9)) };
};
window.isReady = true;
</script>`;

const roots = { three: join(here, 'node_modules/three'), scenes, pictures: join(here, 'pictures') };
const types = { '.js': 'text/javascript', '.png': 'image/png', '.jpg': 'image/jpeg' };
const server = createServer((request, response) => {
  const path = normalize(decodeURIComponent(request.url));
  if (path === '/') return response.setHeader('content-type', 'text/html').end(page);
  const [, root, ...rest] = path.split('/');
  try {
    const bytes = readFileSync(join(roots[root], ...rest));
    const type = types[extname(path)] ?? 'application/octet-stream';
    response.setHeader('content-type', type).end(bytes);
  } catch {
    response.writeHead(404).end();
  }
});
await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
mkdirSync(roots.pictures, { recursive: true });

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});
const tab = await browser.newPage();
tab.on('pageerror', (error) => console.error(error.message));
await tab.goto(`http://127.0.0.1:${server.address().port}/`);
await tab.waitForFunction('window.isReady');

let isGood = true;
console.log('model                           PSNR    pixels of both');
for (const model of models) {
  const picture = model.replace(/.*\//, '') + '.png';
  let line;
  try {
    const report = JSON.parse(execFileSync(mesher, [
      'render', join(scenes, model), '-o', join(roots.pictures, picture), '--json', '--quiet',
      '--look', 'base-color', '--transparent', '--size', `${size.width}x${size.height}`]));
    const result = await tab.evaluate(
      (...all) => window.compare(...all), `/scenes/${model}`, `/pictures/${picture}`,
      report.camera, size);
    isGood &&= result.psnr >= leastPsnr;
    const share = (100 * result.both / result.either).toFixed(1);
    line = `${result.psnr.toFixed(1).padStart(5)} dB  ${share.padStart(5)} %`;
  } catch (error) {
    isGood = false;
    line = `failed: ${error.message.split('\n')[0]}`;
  }
  console.log(`${model.replace(/.*\//, '').padEnd(30)} ${line}`);
}
await browser.close();
server.close();
process.exit(isGood ? 0 : 1);
