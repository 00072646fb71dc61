#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/document/document.h"

namespace mesher::app {

// The meshes of the scene that a model comes from, and its nodes.

/// Returns whether the model has a scene with a mesh of this number; kNone: all meshes.
bool has_mesh(const Document& document, std::uint32_t mesh);
/// Returns the number of faces of one mesh. O(F).
std::uint32_t face_count_of(const Attributes& attributes, std::uint32_t mesh);
/// Returns the number of faces of each mesh of the scene. O(F).
std::vector<std::uint32_t> face_counts(const Attributes& attributes, std::size_t meshes);
/// Returns the nodes that lead to a mesh with faces, depth first: not those of joints, cameras and
/// lights. O(nodes).
std::vector<std::uint32_t> nodes_with_faces(const scene::Scene& scene);
/// The name of a mesh, or its number.
std::string mesh_name(const scene::Scene& scene, std::uint32_t mesh);

/// Makes edits apply to one mesh, or to all (kNone).
void choose_mesh(Document& document, std::uint32_t mesh);
/// Shows or hides a node with everything below it.
void show_node(Document& document, std::uint32_t node, bool is_shown);
/// Hides everything but a node and what is below it.
void isolate_node(Document& document, std::uint32_t node);
void show_all_nodes(Document& document);
/// Isolates the nodes that show the chosen mesh.
void isolate_chosen(Document& document);

/// Why a command cannot run now; null: it can.
const char* need_chosen(const Document& document);
const char* need_hidden(const Document& document);

}  // namespace mesher::app
