#include "engine/render/shaders.h"

namespace mesher::render::shaders {
namespace {

// clang-format off
constexpr std::uint32_t kFlatVertWords[] = {
#include "flat_vert.inc"
};
constexpr std::uint32_t kGouraudVertWords[] = {
#include "gouraud_vert.inc"
};
constexpr std::uint32_t kFlatPulledVertWords[] = {
#include "flat_pulled_vert.inc"
};
constexpr std::uint32_t kGouraudPulledVertWords[] = {
#include "gouraud_pulled_vert.inc"
};
constexpr std::uint32_t kGouraudCornerVertWords[] = {
#include "gouraud_corner_vert.inc"
};
constexpr std::uint32_t kFlatFragWords[] = {
#include "flat_frag.inc"
};
constexpr std::uint32_t kGouraudFragWords[] = {
#include "gouraud_frag.inc"
};
constexpr std::uint32_t kFlatWireFragWords[] = {
#include "flat_wire_frag.inc"
};
constexpr std::uint32_t kGouraudWireFragWords[] = {
#include "gouraud_wire_frag.inc"
};
constexpr std::uint32_t kWireAloneFragWords[] = {
#include "wire_alone_frag.inc"
};
constexpr std::uint32_t kLineVertWords[] = {
#include "line_vert.inc"
};
constexpr std::uint32_t kLineFragWords[] = {
#include "line_frag.inc"
};
constexpr std::uint32_t kBareVertWords[] = {
#include "bare_vert.inc"
};
constexpr std::uint32_t kBareFragWords[] = {
#include "bare_frag.inc"
};
// clang-format on

}  // namespace

const Words kFlatVert = kFlatVertWords;
const Words kGouraudVert = kGouraudVertWords;
const Words kFlatPulledVert = kFlatPulledVertWords;
const Words kGouraudPulledVert = kGouraudPulledVertWords;
const Words kGouraudCornerVert = kGouraudCornerVertWords;
const Words kFlatFrag = kFlatFragWords;
const Words kGouraudFrag = kGouraudFragWords;
const Words kFlatWireFrag = kFlatWireFragWords;
const Words kGouraudWireFrag = kGouraudWireFragWords;
const Words kWireAloneFrag = kWireAloneFragWords;
const Words kLineVert = kLineVertWords;
const Words kLineFrag = kLineFragWords;
const Words kBareVert = kBareVertWords;
const Words kBareFrag = kBareFragWords;

}  // namespace mesher::render::shaders
