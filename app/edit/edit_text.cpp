#include "app/edit/edit_text.h"

#include <algorithm>

#include "app/edit/crease_edits.h"
#include "app/edit/edits.h"
#include "app/edit/progressive_edits.h"
#include "app/edit/simplify_edit.h"
#include "app/edit/subdivide_edit.h"
#include "engine/core/error.h"

namespace mesher::app {
namespace {

std::unique_ptr<EditTask> make_simplify(EditWords& words, const Document& document) {
  return simplify_edit(words, document.simplify);
}

std::unique_ptr<EditTask> make_subdivide(EditWords& words, const Document& document) {
  return subdivide_edit(words, document.subdivide);
}

std::unique_ptr<EditTask> make_crease(EditWords& words, const Document&) {
  return crease_edit(crease_request(words));
}

constexpr EditKind kEditKinds[] = {
    {"simplify", "`mesh=N`, rules of simplification", "remove 10 % of the faces", make_simplify},
    {"simplify_edge", "`mesh=N`, rules of simplification", "collapse one edge", make_simplify},
    {"simplify_to", "`faces=N` or `max-error=PERCENT` or both, `mesh=N`, rules of simplification",
     "simplify the model as it was opened", make_simplify},
    {"subdivide", "`mesh=N`, rules of subdivision", "go to the next level", make_subdivide},
    {"coarsen", "`mesh=N`, rules of subdivision", "go to the previous level", make_subdivide},
    {"change_rules", "`mesh=N`, rules of subdivision", "rebuild the shown level by other rules",
     make_subdivide},
    {"set_sharpness", "`to=2.5` or `to=inf`, `edges=0-4,7`", "set the sharpness of edges",
     make_crease},
    {"change_sharpness", "`by=-1`, `edges=0-4,7`", "make edges sharper or smoother", make_crease},
    {"clear_all_creases", "", "make all edges smooth", make_crease},
    {"mark_creases", "`angle=40`",
     "make edges infinitely sharp whose face normals differ by more degrees", make_crease},
    {"keep_level", "`splits=N`, `base-faces=N`, rules of simplification",
     "use a level of the progressive mesh as the model", keep_level_edit},
};

}  // namespace

std::span<const EditKind> edit_kinds() {
  return kEditKinds;
}

std::unique_ptr<EditTask> edit_from_text(std::string_view text, const Document& document) {
  EditWords words(text);
  const auto kind = std::ranges::find(kEditKinds, words.name(), &EditKind::name);
  if (kind == std::end(kEditKinds)) throw UsageError("there is no edit '" + words.name() + "'");
  std::unique_ptr<EditTask> task = kind->make(words, document);
  words.expect_no_more();
  return task;
}

}  // namespace mesher::app
