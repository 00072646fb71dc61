#include "engine/mesh/parts.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "engine/mesh/bow_tie.h"
#include "engine/mesh/layer_types.h"
#include "engine/mesh/outgoing.h"

namespace mesher {
namespace {

/// Where the elements of a shape go: a part, and a new id in it.
struct PartIds {
  std::size_t count = 0;  ///< of parts
  Array<std::uint32_t> part_of_vertex;
  Array<std::uint32_t> part_of_face;
  Array<std::uint32_t> vertices;
  Array<std::uint32_t> faces;
  Array<std::uint32_t> wedges;

  Vertex operator()(Vertex v) const { return Vertex(vertices[v.index()]); }
  Halfedge operator()(Halfedge h) const {
    if (!h.is_valid()) return h;
    return Halfedge(3 * faces[h.index() / 3] + h.index() % 3);
  }
  Wedge operator()(Wedge w) const { return Wedge(wedges[w.index()]); }
};

/// Numbers the elements of each part in their order.
Array<std::uint32_t> numbers_in_parts(const Array<std::uint32_t>& part_of, std::size_t parts) {
  std::vector<std::uint32_t> next(parts, 0);
  Array<std::uint32_t> numbers(part_of.size());
  for (std::size_t i = 0; i < part_of.size(); ++i)
    numbers[i] = part_of[i] == kNone ? kNone : next[part_of[i]]++;
  return numbers;
}

PartIds part_ids(const Mesh& mesh, const Attributes& attributes,
                 const std::vector<std::uint32_t>& part_of_group, std::size_t parts) {
  PartIds ids{.count = parts};
  ids.part_of_face.resize(mesh.face_count());
  ids.part_of_vertex.assign(mesh.vertex_count(), kNone);
  for (std::uint32_t f = 0; f < mesh.face_count(); ++f) {
    const std::uint32_t part = part_of_group[attributes.group[f]];
    ids.part_of_face[f] = part;
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      ids.part_of_vertex[mesh.origin(Mesh::halfedge(Face(f), corner)).index()] = part;
  }
  ids.faces = numbers_in_parts(ids.part_of_face, parts);
  ids.vertices = numbers_in_parts(ids.part_of_vertex, parts);
  Array<std::uint32_t> part_of_wedge = ids.part_of_vertex;
  for (const Vertex v : attributes.further)
    part_of_wedge.push_back(ids.part_of_vertex[v.index()]);
  ids.wedges = numbers_in_parts(part_of_wedge, parts);
  return ids;
}

std::vector<Mesh> split_mesh(const Mesh& mesh, const PartIds& ids) {
  std::vector<MeshArrays> parts(ids.count);
  for (std::uint32_t i = 0; i < mesh.vertex_count(); ++i) {
    if (ids.part_of_vertex[i] == kNone) continue;
    MeshArrays& part = parts[ids.part_of_vertex[i]];
    part.position.push_back(mesh.position(Vertex(i)));
    part.outgoing.push_back(ids(mesh.outgoing(Vertex(i))));
    if (!mesh.vertex_sharpnesses().empty())
      part.vertex_sharpness.push_back(mesh.sharpness(Vertex(i)));
  }
  for (std::uint32_t i = 0; i < mesh.halfedge_count(); ++i) {
    const Halfedge h(i);
    const std::uint32_t number = ids.part_of_face[Mesh::face(h).index()];
    if (number == kNone) continue;
    parts[number].origin.push_back(ids(mesh.origin(h)));
    parts[number].twin.push_back(ids(mesh.twin(h)));
    parts[number].sharpness.push_back(mesh.sharpness(h));
  }
  for (const auto& [v, first] : mesh.bow_tie_copies()) {
    const std::uint32_t number = ids.part_of_vertex[v.index()];
    if (number != kNone) parts[number].bow_tie_copies.push_back({ids(v), first});
  }
  std::vector<Mesh> meshes;
  for (MeshArrays& part : parts) {
    normalize(part.bow_tie_copies);
    meshes.push_back(std::move(part).finish());
  }
  return meshes;
}

/// Appends the values of a layer to that of the same number of each part.
void split_layer(const AttributeLayer& layer, const PartIds& ids, const Attributes& attributes,
                 std::vector<Shape>& parts) {
  for (Shape& part : parts)
    part.attributes.layers.emplace_back(layer.type(), 0);
  const auto vertices = static_cast<std::uint32_t>(ids.part_of_vertex.size());
  for (std::uint32_t w = 0; w < layer.count(); ++w) {
    const std::uint32_t part = ids.part_of_vertex[attributes.vertex(Wedge(w), vertices).index()];
    if (part == kNone) continue;
    Array<std::byte>& bytes = parts[part].attributes.layers.back().bytes();
    const auto value = layer.value(w);
    bytes.insert(bytes.end(), value.begin(), value.end());
  }
}

void split_wedges(const Attributes& attributes, const PartIds& ids, std::vector<Shape>& parts) {
  for (const Vertex v : attributes.further) {
    const std::uint32_t part = ids.part_of_vertex[v.index()];
    if (part != kNone) parts[part].attributes.further.push_back(ids(v));
  }
  for (std::size_t c = 0; c < attributes.corner_wedge.size(); ++c) {
    const std::uint32_t part = ids.part_of_face[c / 3];
    if (part == kNone || parts[part].attributes.further.empty()) continue;
    parts[part].attributes.corner_wedge.push_back(ids(attributes.corner_wedge[c]));
  }
}

void split_groups(const Attributes& attributes, const std::vector<std::uint32_t>& part_of_group,
                  const PartIds& ids, std::vector<Shape>& parts) {
  std::vector<std::uint32_t> new_group(attributes.groups.size());
  for (std::size_t g = 0; g < new_group.size(); ++g) {
    if (part_of_group[g] == kNone) continue;
    std::vector<FaceGroup>& groups = parts[part_of_group[g]].attributes.groups;
    new_group[g] = static_cast<std::uint32_t>(groups.size());
    groups.push_back(attributes.groups[g]);
  }
  for (std::size_t f = 0; f < attributes.group.size(); ++f) {
    if (ids.part_of_face[f] == kNone) continue;
    parts[ids.part_of_face[f]].attributes.group.push_back(new_group[attributes.group[f]]);
  }
}

/// Numbers of the first elements of a shape among those of all shapes.
struct FirstIds {
  std::uint32_t vertex = 0;
  std::uint32_t halfedge = 0;
  std::uint32_t further = 0;
  std::uint32_t group = 0;

  Vertex operator()(Vertex v) const { return Vertex(v.index() + vertex); }
  Halfedge operator()(Halfedge h) const {
    return h.is_valid() ? Halfedge(h.index() + halfedge) : h;
  }
};

std::vector<FirstIds> first_ids(const std::vector<Shape>& shapes) {
  std::vector<FirstIds> first(1);
  for (const Shape& shape : shapes) {
    FirstIds next = first.back();
    next.vertex += shape.mesh.vertex_count();
    next.halfedge += shape.mesh.halfedge_count();
    next.further += static_cast<std::uint32_t>(shape.attributes.further.size());
    next.group += static_cast<std::uint32_t>(shape.attributes.groups.size());
    first.push_back(next);
  }
  return first;
}

template <class T, class Elements, class Rename>
void append_renamed(Array<T>& all, const Elements& elements, const Rename& rename) {
  for (const T& element : elements)
    all.push_back(rename(element));
}

Mesh joined_meshes(const std::vector<Shape>& shapes, const std::vector<FirstIds>& first) {
  MeshArrays all;
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  const bool has_sharp_vertices = std::ranges::any_of(
      shapes, [](const Shape& shape) { return !shape.mesh.vertex_sharpnesses().empty(); });
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Mesh& mesh = shapes[i].mesh;
    append(all.position, mesh.positions());
    append(all.sharpness, mesh.sharpnesses());
    append_renamed(all.origin, mesh.origins(), first[i]);
    append_renamed(all.twin, mesh.twins(), first[i]);
    append_renamed(all.outgoing, mesh.outgoings(), first[i]);
    append(all.vertex_sharpness, mesh.vertex_sharpnesses());
    if (has_sharp_vertices) all.vertex_sharpness.resize(all.position.size(), 0.0F);
    for (const auto& [v, lowest] : mesh.bow_tie_copies())
      all.bow_tie_copies.push_back({first[i](v), first[i](lowest)});
  }
  return std::move(all).finish();
}

/// Appends values [begin, end) of a shape, which may lack the layer.
void append_values(AttributeLayer& all, const AttributeLayer* from, std::size_t begin,
                   std::size_t end) {
  if (from != nullptr) {
    AttributeLayer some(from->type(), end - begin);
    const std::size_t bytes = from->type().value_bytes();
    std::ranges::copy(std::span(from->bytes()).subspan(begin * bytes, (end - begin) * bytes),
                      some.bytes().begin());
    return append_converted(all, some);
  }
  for (std::size_t i = begin; i < end; ++i) {
    all.resize(all.count() + 1);
    store_absent(all, all.count() - 1);
  }
}

std::vector<AttributeType> joined_types(const std::vector<Shape>& shapes) {
  std::vector<AttributeType> types;
  std::map<std::string, std::size_t> of_name;
  for (const Shape& shape : shapes) {
    for (const AttributeLayer& layer : shape.attributes.layers) {
      const auto [found, is_new] = of_name.try_emplace(layer.type().name, types.size());
      if (is_new) types.push_back(layer.type());
      AttributeType& type = types[found->second];
      type = common_type(type, layer.type());
      // Integers could not say that a normal is absent.
      if (type.kind != AttributeKind::normal || shapes.size() == 1) continue;
      type.component = ComponentType::f32;
      type.is_normalized = false;
    }
  }
  return types;
}

AttributeLayer joined_layer(const AttributeType& type, const std::vector<Shape>& shapes) {
  AttributeLayer all(type, 0);
  // First the first wedges of all vertices, then all further ones.
  for (const Shape& shape : shapes)
    append_values(all, shape.attributes.find(type.name), 0, shape.mesh.vertex_count());
  for (const Shape& shape : shapes) {
    const std::uint32_t vertices = shape.mesh.vertex_count();
    append_values(all, shape.attributes.find(type.name), vertices,
                  vertices + shape.attributes.further.size());
  }
  return all;
}

void append_wedges(Attributes& all, const Shape& shape, const FirstIds& first,
                   std::uint32_t all_vertices) {
  const std::uint32_t vertices = shape.mesh.vertex_count();
  for (std::uint32_t h = 0; h < shape.mesh.halfedge_count(); ++h) {
    const std::uint32_t w = shape.attributes.wedge(shape.mesh.origins(), Halfedge(h)).index();
    all.corner_wedge.emplace_back(w < vertices ? w + first.vertex
                                               : w - vertices + all_vertices + first.further);
  }
}

Attributes joined_attributes(const std::vector<Shape>& shapes, const std::vector<FirstIds>& first) {
  Attributes all;
  for (const AttributeType& type : joined_types(shapes))
    all.layers.push_back(joined_layer(type, shapes));
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Attributes& attributes = shapes[i].attributes;
    append_renamed(all.further, attributes.further, first[i]);
    append_renamed(all.group, attributes.group,
                   [&](std::uint32_t group) { return group + first[i].group; });
    all.groups.insert(all.groups.end(), attributes.groups.begin(), attributes.groups.end());
  }
  if (all.further.empty()) return all;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    append_wedges(all, shapes[i], first[i], first.back().vertex);
  return all;
}

/// The half-edge that runs the other way after a turn, by its place in its face.
Halfedge turned(Halfedge h) {
  return h.is_valid() ? Halfedge(h.index() - h.index() % 3 + (2 - h.index() % 3)) : h;
}

}  // namespace

std::vector<Shape> split(const Mesh& mesh, const Attributes& attributes,
                         const std::vector<std::uint32_t>& part_of_group, std::size_t count) {
  const PartIds ids = part_ids(mesh, attributes, part_of_group, count);
  std::vector<Shape> parts;
  for (Mesh& part : split_mesh(mesh, ids))
    parts.push_back({std::move(part), {}});
  for (const AttributeLayer& layer : attributes.layers)
    split_layer(layer, ids, attributes, parts);
  split_wedges(attributes, ids, parts);
  split_groups(attributes, part_of_group, ids, parts);
  return parts;
}

std::uint64_t joined_layer_bytes(const std::vector<Shape>& shapes) {
  std::uint64_t wedges = 0;
  std::uint64_t now = 0;
  for (const Shape& shape : shapes) {
    wedges += shape.mesh.vertex_count() + shape.attributes.further.size();
    for (const AttributeLayer& layer : shape.attributes.layers)
      now += layer.bytes().size();
  }
  std::uint64_t then = 0;
  for (const AttributeType& type : joined_types(shapes))
    then += wedges * type.value_bytes();
  return then > now ? then - now : 0;
}

Shape joined(std::vector<Shape>&& shapes) {
  if (shapes.size() == 1) return std::move(shapes.front());
  for (Shape& shape : shapes) {
    Attributes& attributes = shape.attributes;
    if (!attributes.group.empty()) continue;
    attributes.group.assign(shape.mesh.face_count(), 0);
    if (attributes.groups.empty()) attributes.groups.emplace_back();
  }
  const std::vector<FirstIds> first = first_ids(shapes);
  return {joined_meshes(shapes, first), joined_attributes(shapes, first)};
}

void turn_over(Shape& shape) {
  MeshArrays arrays = MeshArrays::take(std::move(shape.mesh));
  const MeshArrays before{.twin = arrays.twin, .sharpness = arrays.sharpness};
  for (std::uint32_t h = 0; h < arrays.origin.size(); ++h) {
    const Halfedge to = turned(Halfedge(h));
    arrays.twin[to.index()] = turned(before.twin[h]);
    arrays.sharpness[to.index()] = before.sharpness[h];
  }
  Array<Wedge>& wedges = shape.attributes.corner_wedge;
  for (std::size_t f = 0; f < arrays.origin.size() / 3; ++f) {
    std::swap(arrays.origin[3 * f + 1], arrays.origin[3 * f + 2]);
    if (!wedges.empty()) std::swap(wedges[3 * f + 1], wedges[3 * f + 2]);
  }
  fill_outgoing(arrays);
  shape.mesh = std::move(arrays).finish();
}

}  // namespace mesher
