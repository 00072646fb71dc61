#!/usr/bin/env node
// Compares the texture deviation of mesher with that of meshoptimizer's simplifyWithAttributes, on the
// same real files and at the same numbers of faces.
//
//   scripts/appearance_meshoptimizer.mjs               all files with texture coordinates of
//                                                      ../shared/models/scenes; prints a table
//   scripts/appearance_meshoptimizer.mjs --only NAME   only files whose names contain NAME
//   ... --ratios 0.5,0.1      shares of the faces to keep (default: 0.5,0.25,0.1,0.05)
//   ... --weights 0.5,1       meshoptimizer's weights of a normal and of a texture coordinate
//                             (default: 1,1, "around 1.0" in its documentation)
//   ... --samples 100000      samples per comparison (default: 300000)
//   ... --mesher PROGRAM      build/release/bin/mesher by default
//
// meshoptimizer simplifies each primitive to the ratio, without a limit of the error. Seams may keep it
// from getting there, so mesher simplifies the file to the number of faces that meshoptimizer reached.
// Each result is measured against the input by `mesher compare` (docs/measures.md). A ratio below 1 is
// mesher's favor. Files that meshoptimizer leaves as they are do not count in the medians. A row tells
// why a file cannot be compared.
//
// Needs node 18 and these packages below the folder of the environment variable MESHER_APPEARANCE_TOOLS
// (build/appearance by default):
//   npm install --prefix build/appearance meshoptimizer@1 @gltf-transform/core@4
//     @gltf-transform/extensions@4 @gltf-transform/functions@4 draco3dgltf@1
// Exit code 3: one is missing. 1: no file could be compared.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { basename, dirname, join, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';

const root = resolve(dirname(fileURLToPath(import.meta.url)), '..');
const tools = resolve(process.env.MESHER_APPEARANCE_TOOLS ?? join(root, 'build/appearance'));
const scenes = join(root, '../shared/models/scenes');
const { values: options } = parseArgs({
  options: {
    only: { type: 'string', default: '' },
    ratios: { type: 'string', default: '0.5,0.25,0.1,0.05' },
    weights: { type: 'string', default: '1,1' },
    samples: { type: 'string', default: '300000' },
    mesher: { type: 'string', default: join(root, 'build/release/bin/mesher') },
  },
});

function fail(message, code) {
  console.error(`appearance_meshoptimizer: ${message}`);
  process.exit(code);
}

async function load(name) {
  try {
    const path = createRequire(join(tools, 'node_modules/')).resolve(name);
    return await import(pathToFileURL(path));
  } catch (error) {
    return fail(`needs ${name} in ${tools}/node_modules; the head of this file tells how to install it (${
      error.message.split('\n')[0]})`, 3);
  }
}

const { MeshoptSimplifier, MeshoptDecoder } = await load('meshoptimizer');
const { NodeIO } = await load('@gltf-transform/core');
const { ALL_EXTENSIONS } = await load('@gltf-transform/extensions');
const { compactPrimitive, dequantize, weld } = await load('@gltf-transform/functions');
const { default: draco } = await load('draco3dgltf');
if (!existsSync(options.mesher)) fail(`needs mesher: ${options.mesher} does not exist`, 3);
if (!existsSync(scenes)) fail(`needs models: ${scenes} does not exist`, 3);

await MeshoptSimplifier.ready;
await MeshoptDecoder.ready;
const files = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'meshopt.decoder': MeshoptDecoder,
  'draco3d.decoder': await draco.createDecoderModule(),
});
const [normalWeight, textureWeight] = options.weights.split(',').map(Number);
const weights = { NORMAL: normalWeight, TEXCOORD_0: textureWeight, COLOR_0: 1 };
const triangles = 4;

// The numbers of an attribute, one vertex after the other; integers as they are meant.
function numbers(accessor) {
  const size = accessor.getElementSize();
  const all = new Float32Array(size * accessor.getCount());
  for (let i = 0; i < accessor.getCount(); ++i) all.set(accessor.getElement(i, []), size * i);
  return all;
}

function simplifyPrimitive(primitive, ratio) {
  const indices = primitive.getIndices();
  const counted = Object.keys(weights).filter((name) => primitive.getAttribute(name));
  const parts = counted.map((name) => primitive.getAttribute(name));
  const stride = parts.reduce((sum, part) => sum + part.getElementSize(), 0);
  const positions = primitive.getAttribute('POSITION');
  const attributes = new Float32Array(stride * positions.getCount());
  let first = 0;
  for (const part of parts) {
    const values = numbers(part);
    const size = part.getElementSize();
    for (let i = 0; i < part.getCount(); ++i)
      attributes.set(values.subarray(size * i, size * (i + 1)), stride * i + first);
    first += size;
  }
  const perNumber = counted.flatMap(
    (name, i) => Array(parts[i].getElementSize()).fill(weights[name]));
  const target = 3 * Math.max(1, Math.round((ratio * indices.getCount()) / 3));
  const [kept] = MeshoptSimplifier.simplifyWithAttributes(
    Uint32Array.from(indices.getArray()), numbers(positions), 3, attributes, stride, perNumber, null,
    target, Number.MAX_VALUE);
  primitive.setIndices(indices.clone().setArray(kept));
  compactPrimitive(primitive);
}

// Writes what meshoptimizer makes of a file. Returns whether the file has texture coordinates.
async function simplifyByMeshoptimizer(file, output, ratio) {
  const document = await files.read(file);
  await document.transform(dequantize(), weld());
  let isTextured = false;
  for (const mesh of document.getRoot().listMeshes()) {
    for (const primitive of mesh.listPrimitives()) {
      if (primitive.getMode() !== triangles) continue;
      isTextured ||= primitive.getAttribute('TEXCOORD_0') !== null;
      simplifyPrimitive(primitive, ratio);
    }
  }
  for (const extension of document.getRoot().listExtensionsUsed()) {
    if (/compression|quantization/.test(extension.extensionName)) extension.dispose();
  }
  await files.write(output, document);
  return isTextured;
}

function mesher(...words) {
  try {
    return execFileSync(options.mesher, [...words.map(String), '--quiet'], {
      encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 2 ** 28 });
  } catch (error) {
    throw new Error((error.stderr || error.message).trim().split('\n').pop());
  }
}

function measure(file, simplified) {
  const found = JSON.parse(mesher('compare', file, simplified, '--json', '--samples', options.samples));
  return {
    isReduced: found.second_faces < found.first_faces,
    faces: found.second_faces,
    texture: found.texture_deviation?.two_sided.rms_percent,
    slide: found.uv_slide_texels?.two_sided.p90,
    normal: found.normal_deviation_deg?.two_sided.mean,
    shape: found.two_sided.rms_percent,
  };
}

function median(values) {
  const sorted = [...values].sort((a, b) => a - b);
  const middle = sorted.length >> 1;
  return sorted.length % 2 === 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

const measures = [
  ['texture', 'texture rms %'], ['slide', 'slide p90'], ['normal', 'normal deg'],
  ['shape', 'shape rms %']];
const ratios = Object.fromEntries(measures.map(([key]) => [key, []]));

function text(value) {
  return value === undefined ? '-' : value.toPrecision(3);
}

function printRow(file, ratio, ours, theirs) {
  const cells = measures.map(([key]) => {
    const share = ours[key] / theirs[key];
    if (Number.isFinite(share) && theirs.isReduced) ratios[key].push(share);
    return `${text(ours[key])} / ${text(theirs[key])} = ${
      Number.isFinite(share) ? share.toFixed(2) : '-'}`.padEnd(28);
  });
  console.log(`${basename(file).padEnd(26)} ${String(ratio).padEnd(5)} ${
    `${ours.faces} / ${theirs.faces}`.padEnd(16)} ${cells.join(' ')}`);
}

console.log(`meshoptimizer's weights: normal ${normalWeight}, texture ${textureWeight}. mesher / meshoptimizer = ratio`);
console.log(`${'file'.padEnd(26)} ${'ratio'.padEnd(5)} ${'faces'.padEnd(16)} ${
  measures.map(([, title]) => title.padEnd(28)).join(' ')}`);
const found = readdirSync(scenes, { recursive: true }).sort()
  .filter((name) => /\.(glb|gltf)$/.test(name) && basename(name).includes(options.only));
const folder = mkdtempSync(join(tmpdir(), 'appearance-'));
const [ours, theirs] = [join(folder, 'mesher.glb'), join(folder, 'meshoptimizer.glb')];
try {
  for (const name of found) {
    const file = join(scenes, name);
    for (const ratio of options.ratios.split(',').map(Number)) {
      try {
        if (!(await simplifyByMeshoptimizer(file, theirs, ratio))) break;
        const other = measure(file, theirs);
        mesher('simplify', file, '-o', ours, '--faces', other.faces);
        printRow(file, ratio, measure(file, ours), other);
      } catch (error) {
        console.log(`${basename(file).padEnd(26)} ${String(ratio).padEnd(5)} failed: ${
          error.message.split('\n')[0]}`);
      }
    }
  }
} finally {
  rmSync(folder, { recursive: true });
}
for (const [key, title] of measures) {
  const all = ratios[key];
  if (all.length > 0) console.log(`median of ${all.length} ratios, ${title}: ${median(all).toFixed(2)}`);
}
process.exit(ratios.texture.length > 0 ? 0 : 1);
