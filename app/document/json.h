#pragma once

#include <array>
#include <nlohmann/json.hpp>

#include "app/document/session.h"
#include "app/document/simplification.h"
#include "engine/analysis/distance.h"
#include "engine/analysis/hausdorff.h"
#include "engine/core/option.h"
#include "engine/io/pm_file.h"

namespace mesher::app {

/// Keeps keys in the order of insertion.
using Json = nlohmann::ordered_json;

/// The options that a table describes, by their JSON keys.
template <class S, std::size_t N>
Json options_json(const std::array<Option<S>, N>& table, const S& options) {
  Json json = Json::object();
  for (const Option<S>& option : table) {
    const auto value = [&](const auto& member) -> Json {
      if constexpr (std::is_same_v<std::decay_t<decltype(member)>, EnumMember<S>>) {
        return member.text(member.get(options)).key;
      } else {
        return options.*member;
      }
    };
    json[json_key(option)] = std::visit(value, option.member);
  }
  return json;
}

Json to_json(const Statistics& statistics);
/// Every kind of repair with its count, including zeros.
Json to_json(const BuildReport& report);
/// What a file held: counts of its kinds of content, each with names if there are any.
Json to_json(const FileContents& contents);
/// `{"file", "name", "statistics", "repairs"}`.
Json to_json(const Model& model, const Statistics& statistics, const std::filesystem::path& file);
/// The progressive mesh of a file, as `mesher info` prints it.
Json to_json(const io::PmSummary& summary);
/// Both directions and the larger of them, each in model units and percent of the diagonal.
Json to_json(const analysis::SurfaceDistance& distance);
/// As above, with the interval that holds the two-sided maximum.
Json to_json(const analysis::SurfaceDistance& distance,
             const analysis::DistanceInterval& certified);
/// The report of a simplification: target, result, stop reason, refusals, errors, seconds.
Json to_json(const SimplifyOutcome& outcome);
/// What became of loose cards; null if there are none.
Json to_json(const simplify::ThinnedCards& cards);
/// The state of a session, for `--json` and the state log.
Json to_json(const Session& session);

/// As text. Bytes of file names that are not UTF-8 become replacement characters. `indent` -1: one
/// line.
std::string to_text(const Json& json, int indent = 2);

}  // namespace mesher::app
