// Compares pairs of glTF files with readers that are not ours. Reads lines
// "MODE<tab>INPUT<tab>OUTPUT<tab>LOST" and prints a JSON line for each. MODE is "copy" (everything is the same, bit for bit) or "edit"
// (the vertices of meshes may differ).
import fs from 'node:fs';
import path from 'node:path';
import readline from 'node:readline';
import { NodeIO, Logger } from '@gltf-transform/core';
import { ALL_EXTENSIONS } from '@gltf-transform/extensions';
import draco3d from 'draco3dgltf';
import validator from 'gltf-validator';
import { MeshoptDecoder } from 'meshoptimizer';

/// Extensions that say how vertices are stored, which an edit may change.
const STORAGE = ['KHR_draco_mesh_compression', 'EXT_meshopt_compression', 'KHR_mesh_quantization'];

const io = new NodeIO()
  .setLogger(new Logger(Logger.Verbosity.SILENT))
  .registerExtensions(ALL_EXTENSIONS)
  .registerDependencies({
    'draco3d.decoder': await draco3d.createDecoderModule(),
    'meshopt.decoder': MeshoptDecoder,
  });
await MeshoptDecoder.ready;

/// The codes of the errors that the Khronos validator finds, each with its number.
async function errorsOf(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    uri: path.basename(file),
    maxIssues: 0,
    externalResourceFunction: async (uri) =>
      new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri)))),
  });
  const counts = {};
  for (const message of report.issues.messages)
    if (message.severity === 0) counts[message.code] = (counts[message.code] ?? 0) + 1;
  return counts;
}

/// The JSON of a file, without what says where its bytes lie.
function documentOf(file) {
  const bytes = fs.readFileSync(file);
  const isBinary = bytes.subarray(0, 4).toString() === 'glTF';
  const text = isBinary ? bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString() : bytes.toString();
  const document = JSON.parse(text);
  for (const key of ['buffers', 'bufferViews', 'accessors']) delete document[key];
  for (const image of document.images ?? []) {
    for (const key of ['uri', 'bufferView', 'mimeType']) delete image[key];
  }
  return document;
}

function canonical(value) {
  if (Array.isArray(value)) return value.map(canonical);
  if (value === null || typeof value !== 'object') return value;
  return Object.fromEntries(Object.keys(value).sort().map((key) => [key, canonical(value[key])]));
}

const same = (a, b) => JSON.stringify(canonical(a)) === JSON.stringify(canonical(b));

/// Removes what `lost` says that the output does not hold: "tangents (TANGENT) of mesh 0".
function removeLost(document, lost) {
  for (const [, name, index] of lost.matchAll(/\((target \d+ \S+|\S+)\) of mesh (\d+)/g)) {
    for (const primitive of document.meshes?.[Number(index)]?.primitives ?? []) {
      const [, target, attribute] = name.match(/^target (\d+) (\S+)$/) ?? [];
      if (target === undefined) delete primitive.attributes[name];
      else delete primitive.targets?.[Number(target)]?.[attribute];
    }
  }
}

/// Which members of two documents differ. Edited meshes may name other accessors and lose extensions.
function differencesOf(a, b, mode) {
  const names = new Set([...Object.keys(a), ...Object.keys(b)]);
  if (mode === 'edit') {
    // Levels of detail are nodes of their own, which channels of their own move.
    for (const animation of b.animations ?? [])
      animation.channels = animation.channels.filter((c) => !(c.target.node >= (a.nodes ?? []).length));
    for (const document of [a, b]) {
      for (const key of ['extensionsUsed', 'extensionsRequired']) {
        const kept = (document[key] ?? []).filter(
          (name) => !STORAGE.includes(name));
        if (kept.length > 0) document[key] = kept;
        else delete document[key];
      }
      for (const mesh of document.meshes ?? []) {
        for (const primitive of mesh.primitives) {
          const isTriangles = (primitive.mode ?? 4) >= 4;
          if (isTriangles) delete primitive.mode;
          delete primitive.indices;
          delete primitive.extensions?.KHR_draco_mesh_compression;
          if (primitive.extensions && Object.keys(primitive.extensions).length === 0) delete primitive.extensions;
          primitive.attributes = Object.keys(primitive.attributes).sort();
          primitive.targets = primitive.targets?.map((target) => Object.keys(target).sort());
        }
      }
    }
  }
  return [...names].filter((name) => !same(a[name], b[name]));
}

const equalBytes = (a, b) =>
  a === b || (a && b && a.length === b.length && Buffer.compare(Buffer.from(a.buffer, a.byteOffset, a.byteLength),
    Buffer.from(b.buffer, b.byteOffset, b.byteLength)) === 0);

const equalAccessors = (a, b) =>
  a === b || (a && b && a.getType() === b.getType() && a.getNormalized() === b.getNormalized() &&
    equalBytes(a.getArray(), b.getArray()));

function equalPrimitives(a, b) {
  const parts = (p) => [p, ...p.listTargets()];
  return equalAccessors(a.getIndices(), b.getIndices()) && parts(a).length === parts(b).length &&
    parts(a).every((x, i) => {
      const y = parts(b)[i];
      return same(x.listSemantics().sort(), y.listSemantics().sort()) &&
        x.listSemantics().every((name) => equalAccessors(x.getAttribute(name), y.getAttribute(name)));
    });
}

/// What a material says, with the numbers of its textures.
function materialValues(material, textures) {
  const number = (texture) => (texture ? textures.indexOf(texture) : -1);
  return [
    material.getName(), material.getExtras(), material.getBaseColorFactor(), material.getMetallicFactor(),
    material.getRoughnessFactor(), material.getEmissiveFactor(), material.getNormalScale(),
    material.getOcclusionStrength(), material.getAlphaMode(), material.getAlphaCutoff(), material.getDoubleSided(),
    number(material.getBaseColorTexture()), number(material.getMetallicRoughnessTexture()),
    number(material.getNormalTexture()), number(material.getOcclusionTexture()),
    number(material.getEmissiveTexture()), material.listExtensions().map((e) => e.extensionName).sort(),
  ];
}

/// The kinds of content that differ between two documents as @gltf-transform/core reads them.
function contentDifferences(a, b, mode) {
  const differ = [];
  const check = (name, list, equal) => {
    const [x, y] = [list(a.getRoot()), list(b.getRoot())];
    if (x.length !== y.length || !x.every((element, i) => equal(element, y[i]))) differ.push(name);
  };
  const numbersOf = (list) => (element) => (element ? list.indexOf(element) : -1);
  check('nodes', (root) => root.listNodes().map((node) => [
    node.getName(), node.getMatrix(), node.getWeights(), numbersOf(root.listMeshes())(node.getMesh()),
    numbersOf(root.listSkins())(node.getSkin()), numbersOf(root.listCameras())(node.getCamera()),
    node.listChildren().map(numbersOf(root.listNodes())), node.getExtras(), node.listExtensions().length,
  ]), same);
  check('meshes', (root) => root.listMeshes().map((mesh) => [
    mesh.getName(), mesh.getWeights(), mesh.getExtras(),
    mesh.listPrimitives().map((p) => [numbersOf(root.listMaterials())(p.getMaterial()), mode === 'copy' ? p.getMode() : 0, p.getExtras(),
      mode === 'copy' ? p.listSemantics().sort() : [], p.listTargets().length]),
  ]), same);
  if (mode === 'copy') {
    check('vertex data', (root) => root.listMeshes().flatMap((mesh) => mesh.listPrimitives()), equalPrimitives);
  }
  check('materials', (root) => root.listMaterials().map((m) => materialValues(m, root.listTextures())), same);
  check('textures', (root) => root.listTextures(),
    (x, y) => x.getName() === y.getName() && equalBytes(x.getImage(), y.getImage()));
  check('skins', (root) => root.listSkins().map((skin) => [skin, root]), ([x, rootX], [y, rootY]) =>
    equalAccessors(x.getInverseBindMatrices(), y.getInverseBindMatrices()) &&
    same(x.listJoints().map(numbersOf(rootX.listNodes())), y.listJoints().map(numbersOf(rootY.listNodes()))));
  check('animations', (root) => root.listAnimations(), (x, y) =>
    x.getName() === y.getName() &&
    (mode === 'copy' ? x.listChannels().length === y.listChannels().length
      : x.listChannels().length <= y.listChannels().length) &&
    x.listSamplers().every((sampler, i) =>
      equalAccessors(sampler.getInput(), y.listSamplers()[i].getInput()) &&
      equalAccessors(sampler.getOutput(), y.listSamplers()[i].getOutput())));
  check('morph targets', (root) => root.listMeshes().flatMap((m) => m.listPrimitives().map((p) => p.listTargets().length)), same);
  check('extensions', (root) => root.listExtensionsUsed().map((e) => e.extensionName)
    .filter((name) => mode === 'copy' || !STORAGE.includes(name)).sort(), same);
  check('cameras', (root) => root.listCameras(), (x, y) => x.equals(y));
  return differ;
}

async function compare(mode, input, output, lost) {
  const result = { mode, input, output };
  const before = await errorsOf(input);
  const after = await errorsOf(output);
  result.inputErrors = Object.keys(before).length > 0 ? before : undefined;
  // A level of detail repeats the errors of its mesh.
  const known = (code) => (mode === 'copy' ? before[code] ?? 0 : code in before ? Infinity : 0);
  result.newErrors = Object.keys(after).filter((code) => after[code] > known(code));
  const document = documentOf(input);
  removeLost(document, lost);
  result.json = differencesOf(document, documentOf(output), mode);
  try {
    result.content = contentDifferences(await io.read(input), await io.read(output), mode);
  } catch (error) {
    result.unreadable = error.message;
    result.content = [];
  }
  return result;
}

for await (const line of readline.createInterface({ input: process.stdin })) {
  const [mode, input, output, lost] = line.split('\t');
  let result;
  try {
    result = await compare(mode, input, output, lost);
  } catch (error) {
    result = { mode, input, output, failed: error.message };
  }
  console.log(JSON.stringify(result));
}
