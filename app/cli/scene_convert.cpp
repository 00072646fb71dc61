#include <fmt/format.h>

#include "app/cli/batch.h"
#include "app/cli/scene.h"
#include "app/cli/scene_commands.h"

namespace mesher::app {

void convert_scene(const InputOptions& input, const std::string& output, bool repairs,
                   const CommonOptions& common) {
  check_output(output);
  CommonOptions reading = common;
  reading.quiet |= !repairs;  // what was repaired for counting is not written
  LoadedScene scene = load_scene(input, reading);
  std::vector<io::GltfMeshEdit> edits;
  if (repairs) {
    for (const io::GltfSceneMesh& mesh : scene.meshes)
      edits.push_back(edit_of(mesh));
  }
  const std::vector<std::string> losses = write_scene(output, scene, edits, common);
  if (!common.quiet) say_scene(output, scene);
  if (!common.json) return;
  print_json({{"file", scene.file.string()},
              {"output", output},
              {"meshes", scene.meshes.size()},
              {"vertices", scene.vertex_count()},
              {"faces", scene.face_count()},
              {"contents", to_json(scene.scene->contents())},
              {"repairs", to_json(repairs ? scene.report : BuildReport())},
              {"lost", losses}});
}

}  // namespace mesher::app
