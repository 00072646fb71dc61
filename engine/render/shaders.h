#pragma once

#include <cstdint>
#include <span>

/// SPIR-V of the shaders in shaders/, compiled by the build. One entry per variant.
namespace mesher::render::shaders {

using Words = std::span<const std::uint32_t>;

extern const Words kFlatVert;           ///< indexed vertices
extern const Words kGouraudVert;        ///< indexed vertices, one normal each
extern const Words kFlatPulledVert;     ///< by half-edge, with barycentric coordinates
extern const Words kGouraudPulledVert;  ///< by half-edge, one normal per vertex
extern const Words kGouraudCornerVert;  ///< by half-edge, one normal per half-edge
extern const Words kFlatFrag;
extern const Words kGouraudFrag;
extern const Words kFlatWireFrag;
extern const Words kGouraudWireFrag;
extern const Words kWireAloneFrag;
// The same with vertices that move during a geomorph and may have a color each.
extern const Words kFlatMorphVert;
extern const Words kGouraudMorphVert;
extern const Words kFlatPulledMorphVert;
extern const Words kGouraudPulledMorphVert;
extern const Words kGouraudCornerMorphVert;
extern const Words kFlatTintFrag;
extern const Words kGouraudTintFrag;
extern const Words kFlatWireTintFrag;
extern const Words kGouraudWireTintFrag;
extern const Words kLineMorphVert;
extern const Words kEdgeMorphVert;
// The same with vertices that follow the matrices of a palette.
extern const Words kFlatPosedVert;
extern const Words kGouraudPosedVert;
extern const Words kFlatPulledPosedVert;
extern const Words kGouraudPulledPosedVert;
extern const Words kGouraudCornerPosedVert;
extern const Words kLinePosedVert;
extern const Words kEdgePosedVert;
extern const Words kLineVert;  ///< listed edges as quads
extern const Words kEdgeVert;  ///< every ordinary edge as a quad
extern const Words kLineFrag;
// Surfaces with materials, in each look. The Wire variants have ordinary edges.
extern const Words kLookVert;  ///< by half-edge, with attributes by wedge
extern const Words kLookWireVert;
extern const Words kLookMorphVert;  ///< with vertices that move during a geomorph
extern const Words kLookMorphWireVert;
extern const Words kMaterialFrag;
extern const Words kMaterialWireFrag;
extern const Words kBaseColorFrag;
extern const Words kBaseColorWireFrag;
extern const Words kNormalsFrag;
extern const Words kNormalsWireFrag;
extern const Words kCheckerFrag;
extern const Words kCheckerWireFrag;
extern const Words kBareVert;
extern const Words kBareFrag;

}  // namespace mesher::render::shaders
