#pragma once

#include <nlohmann/json.hpp>

#include "app/pm_file.h"
#include "app/session.h"
#include "engine/analysis/distance.h"
#include "engine/analysis/hausdorff.h"

namespace mesher::app {

/// Keys in the order in which they were put in.
using Json = nlohmann::ordered_json;

Json to_json(const Statistics& statistics);
/// Every kind of repair with its count, zeros too.
Json to_json(const BuildReport& report);
/// `{"file", "name", "statistics", "repairs"}`.
Json to_json(const Model& model, const Statistics& statistics, const std::filesystem::path& file);
/// What `mesher info` says of a file with a progressive mesh.
Json to_json(const PmSummary& summary);
/// Both directions and the larger of them, each in units and percent.
Json to_json(const SurfaceDistance& distance);
/// The same, and the interval in which the largest distance lies, both ways.
Json to_json(const SurfaceDistance& distance, const DistanceInterval& certified);
/// The ledger of a simplification: asked, reached, why it ended, refusals, errors, seconds.
Json to_json(const SimplifyOutcome& outcome);
/// What a session shows: for `--json` and the state log.
Json to_json(const Session& session);

/// As text; names of files that are not UTF-8 get a replacement character. `indent` -1: one line.
std::string to_text(const Json& json, int indent = 2);

}  // namespace mesher::app
