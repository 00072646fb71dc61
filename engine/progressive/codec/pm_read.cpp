#include "engine/progressive/codec/pm_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <utility>

#include "engine/core/error.h"
#include "engine/core/face_limit.h"
#include "engine/core/text.h"
#include "engine/mesh/outgoing.h"
#include "engine/mesh/validate.h"
#include "engine/progressive/codec/attribute_coder.h"
#include "engine/progressive/codec/pm_base.h"
#include "engine/progressive/codec/pm_format.h"
#include "engine/progressive/codec/range_coder.h"
#include "engine/progressive/codec/split_coder.h"
#include "engine/progressive/split_appender.h"

namespace mesher::progressive {
namespace {

/// The part of the file expected next.
enum class Stage { header, base, block, done, damaged };

}  // namespace

struct PmReader::State {
  std::string name;
  Stage stage = Stage::header;
  Array<std::byte> waiting;      ///< bytes that have arrived but were not consumed
  std::uint64_t used_bytes = 0;  ///< number of consumed bytes before `waiting`
  PmHeader header;
  std::uint32_t check = 0;  ///< checksum of everything so far
  ProgressiveMesh mesh;
  bool has_base = false;
  bool ignores_what_follows = false;
  ProgressiveAttributes attributes;
  Array<std::byte> appendix;
  std::uint64_t attribute_bytes = 0;
  std::unique_ptr<SplitCoder<RangeDecoder>> coder;
  std::unique_ptr<AttributeCoder<RangeDecoder>> attribute_coder;  ///< null: there are none
  std::uint32_t expected_splits = 0;                              ///< 0: unknown
  std::string damage;

  explicit State(std::string&& file) : name(std::move(file)) {}

  std::string at_byte(std::uint64_t byte, std::string_view reason) const {
    return fmt::format("byte {}: {}", count_text(byte), reason);
  }

  [[noreturn]] void refuse(std::uint64_t byte, std::string_view reason) {
    stage = Stage::damaged;
    damage = at_byte(byte, reason);
    throw InputError(name, 0, damage);
  }

  void check_faces(std::uint64_t faces) const {
    try {
      FaceLimit::check(faces);
    } catch (const InputError& error) {
      throw InputError(name, 0, error.reason());
    }
  }

  void end_early(std::uint64_t byte, std::string_view reason) {
    stage = Stage::damaged;
    damage = fmt::format("{}; {} of {} splits were read", at_byte(byte, reason),
                         count_text(mesh.split_count()), count_text(header.splits));
  }

  /// Consumes the complete part at the start of `bytes`; returns its size. `used_bytes` precede it.
  std::size_t take(std::span<const std::byte> bytes) {
    switch (stage) {
      case Stage::header:
        return take_header(bytes);
      case Stage::base:
        return take_base(bytes);
      case Stage::block:
        return take_block(bytes);
      case Stage::done:
        if (!bytes.empty() && !ignores_what_follows)
          end_early(used_bytes, "bytes follow after the last split");
        return 0;
      case Stage::damaged:
        return 0;
    }
    return 0;
  }

  std::size_t take_header(std::span<const std::byte> bytes) {
    const std::size_t shown = std::min(bytes.size(), kPmMagic.size());
    if (std::memcmp(bytes.data(), kPmMagic.data(), shown) != 0) {
      refuse(used_bytes, "not a progressive mesh, or one that was sent as text");
    }
    if (bytes.size() < kPmHeaderBytes) return 0;
    const std::string_view why = pm_parse(bytes.first(kPmHeaderBytes), header);
    if (!why.empty()) refuse(used_bytes, why);
    check_faces(header.base_faces);
    stage = Stage::base;
    return kPmHeaderBytes;
  }

  std::size_t take_base(std::span<const std::byte> bytes) {
    const std::uint64_t size = base_size(bytes);
    if (size == 0 || bytes.size() < size) return 0;
    const auto payload = bytes.first(header.base_bytes);
    if (pm_check(header.check, payload) != header.base_check) {
      refuse(used_bytes, "the checksum of the base mesh is wrong");
    }
    PmBase base;
    const std::string_view why = decode_base(header, payload, base);
    if (!why.empty()) refuse(used_bytes, why);
    fill_outgoing(base.arrays);
    Mesh first = std::move(base.arrays).finish();
    const auto violations = validate(first, 1);
    if (!violations.empty()) refuse(used_bytes, "the base is no mesh: " + violations.front().what);
    mesh = ProgressiveMesh(std::move(first));
    mesh.mesh().changes().note_all();  // nobody has seen it, so later changes need not be recorded
    coder = std::make_unique<SplitCoder<RangeDecoder>>(header, std::move(base.grid));
    check = header.base_check;
    if (header.has_attributes()) take_base_attributes(bytes.first(size).subspan(header.base_bytes));
    has_base = true;
    stage = header.splits == 0 ? Stage::done : Stage::block;
    return size;
  }

  /// Returns the size of the base with its attributes; 0 if it is not known yet.
  std::uint64_t base_size(std::span<const std::byte> bytes) const {
    if (!header.has_attributes()) return header.base_bytes;
    const std::uint64_t head = header.base_bytes + std::uint64_t{kPmBaseAttributesHeaderBytes};
    if (bytes.size() < head) return 0;
    const auto of_attributes = bytes.subspan(header.base_bytes, kPmBaseAttributesHeaderBytes);
    return head + pm_parse_base_attributes(of_attributes).total_bytes();
  }

  void take_base_attributes(std::span<const std::byte> bytes) {
    const std::uint64_t at = used_bytes + header.base_bytes;
    const PmBaseAttributesHeader head = pm_parse_base_attributes(bytes);
    check = pm_check(check, bytes.first(kPmBaseAttributesHeaderBytes - 4));
    const auto parts = bytes.subspan(kPmBaseAttributesHeaderBytes);
    check = pm_check(check, parts);
    if (check != head.check) refuse(at, "the checksum of the attributes is wrong");
    AttributeTable table;
    const std::string_view why = decode_table(parts.first(head.table_bytes), table);
    if (!why.empty()) refuse(at, why);
    const bool is_empty = table.layers.empty() && !table.has_face_groups;
    attribute_coder = std::make_unique<AttributeCoder<RangeDecoder>>(header, std::move(table),
                                                                     attributes, nullptr);
    RangeDecoder decoder(parts.subspan(head.table_bytes, head.bytes));
    const std::string_view bad = attribute_coder->code_base(decoder, mesh.mesh(), head.bytes);
    if (!bad.empty()) refuse(at, bad);
    if (is_empty) attribute_coder.reset();
    const auto rest = parts.subspan(std::size_t{head.table_bytes} + head.bytes);
    appendix.assign(rest.begin(), rest.end());
    attribute_bytes = bytes.size();
  }

  std::size_t take_block(std::span<const std::byte> bytes) {
    if (bytes.size() < kPmBlockHeaderBytes) return 0;
    const PmBlockHeader block = pm_parse_block(bytes.first(kPmBlockHeaderBytes));
    const std::string_view why = objection(block);
    if (!why.empty()) {
      end_early(used_bytes, why);
      return 0;
    }
    const std::size_t mesh_size = kPmBlockHeaderBytes + block.bytes;
    if (bytes.size() < mesh_size) return 0;
    const auto payload = bytes.subspan(kPmBlockHeaderBytes, block.bytes);
    std::uint32_t block_check = pm_block_check(check, block.splits, payload);
    if (block_check != block.check) {
      end_early(used_bytes, "the checksum of a block is wrong");
      return 0;
    }
    std::span<const std::byte> of_attributes;
    std::size_t attributes_size = 0;
    if (header.has_attributes()) {
      const auto rest = bytes.subspan(mesh_size);
      if (rest.size() < kPmAttributesHeaderBytes) return 0;
      const PmAttributesHeader head = pm_parse_attributes(rest.first(kPmAttributesHeaderBytes));
      if (rest.size() - kPmAttributesHeaderBytes < head.bytes) return 0;
      of_attributes = rest.subspan(kPmAttributesHeaderBytes, head.bytes);
      block_check = pm_check(block_check, rest.first(kPmAttributesHeaderBytes - 4));
      block_check = pm_check(block_check, of_attributes);
      if (block_check != head.check) {
        end_early(used_bytes + mesh_size, "the checksum of the attributes of a block is wrong");
        return 0;
      }
      attributes_size = kPmAttributesHeaderBytes + head.bytes;
    }
    check = block_check;
    try {
      if (!append(block.splits, payload, of_attributes)) return 0;
    } catch (const std::bad_alloc&) {
      // The models have adapted to splits that the mesh lacks, so the rest cannot be decoded.
      end_early(used_bytes, "memory ran out");
      throw;
    }
    if (mesh.split_count() == header.splits) stage = Stage::done;
    attribute_bytes += attributes_size;
    return mesh_size + attributes_size;
  }

  std::string_view objection(const PmBlockHeader& block) const {
    if (block.splits == 0 || block.splits > kPmMostBlockSplits ||
        block.splits > header.splits - mesh.split_count() ||
        block.bytes < pm_least_bytes(block.splits) || block.bytes > pm_most_bytes(block.splits)) {
      return "the header of a block makes no sense";
    }
    return {};
  }

  /// Reserves memory for the expected splits, or for half as many again as have arrived.
  void reserve(std::uint32_t count) {
    const std::uint64_t before = mesh.split_count();
    if (before + count <= mesh.split_capacity()) return;
    const std::uint64_t wanted =
        std::max<std::uint64_t>({before + count, expected_splits, before + before / 2});
    const auto splits = static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, header.splits));
    mesh.reserve(splits);
    coder->reserve(mesh.base_vertex_count(), splits);
    if (attribute_coder) attribute_coder->reserve(splits);
  }

  bool append(std::uint32_t count, std::span<const std::byte> payload,
              std::span<const std::byte> of_attributes) {
    reserve(count);
    RangeDecoder decoder(payload);
    RangeDecoder attribute_decoder(of_attributes);
    if (attribute_coder)
      attribute_coder->begin_block(mesh.split_count() + count, of_attributes.size());
    coder->begin_block(mesh.split_count(), mesh.split_count() + count);
    SplitAppender appender(mesh, count);
    for (std::uint32_t i = 0; i < count; ++i) {
      NewSplit split;
      const std::string_view why = coder->code(decoder, mesh, split);
      if (!why.empty()) {
        end_early(used_bytes, why);
        return false;
      }
      appender.append(split, coder->fan());
      const std::string_view bad = append_attributes(attribute_decoder, appender);
      if (!bad.empty()) {
        end_early(used_bytes, bad);
        return false;
      }
    }
    check_faces(mesh.full_face_count());
    return true;
  }

  /// Appends the attributes of the last split. If there are none, removes the split.
  std::string_view append_attributes(RangeDecoder& decoder, SplitAppender& appender) {
    if (!attribute_coder) return {};
    try {
      const std::string_view why = attribute_coder->code_split(decoder, mesh);
      if (!why.empty()) appender.remove_last();
      return why;
    } catch (const std::bad_alloc&) {
      appender.remove_last();
      throw;
    }
  }

  void feed(std::span<const std::byte> bytes) {
    if (stage == Stage::damaged) return;
    waiting.insert(waiting.end(), bytes.begin(), bytes.end());
    if (has_base) {
      mesh.go_to(mesh.split_count());
      attributes.go_to(attributes.split_count());
    }
    std::size_t used = 0;
    while (stage != Stage::damaged && used < waiting.size()) {
      const std::size_t now = take(std::span(waiting).subspan(used));
      if (now == 0) break;
      used += now;
      used_bytes += now;
    }
    waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(used));
  }
};

PmReader::PmReader(std::string name) : state_(std::make_unique<State>(std::move(name))) {}
PmReader::~PmReader() = default;
PmReader::PmReader(PmReader&&) noexcept = default;
PmReader& PmReader::operator=(PmReader&&) noexcept = default;

bool PmReader::is_pm(std::span<const std::byte> begin) {
  return begin.size() >= kPmMagic.size() &&
         std::memcmp(begin.data(), kPmMagic.data(), kPmMagic.size()) == 0;
}

void PmReader::ignore_what_follows() {
  state_->ignores_what_follows = true;
}

std::uint32_t PmReader::count_splits(std::span<const std::byte> file) {
  PmHeader header;
  if (file.size() < kPmHeaderBytes || !pm_parse(file.first(kPmHeaderBytes), header).empty())
    return 0;
  std::uint64_t splits = 0;
  std::uint64_t at = kPmHeaderBytes + std::uint64_t{header.base_bytes};
  if (header.has_attributes()) {
    if (at + kPmBaseAttributesHeaderBytes > file.size()) return 0;
    const auto head = file.subspan(at, kPmBaseAttributesHeaderBytes);
    at += kPmBaseAttributesHeaderBytes + pm_parse_base_attributes(head).total_bytes();
  }
  while (at + kPmBlockHeaderBytes <= file.size()) {
    const PmBlockHeader block = pm_parse_block(file.subspan(at, kPmBlockHeaderBytes));
    at += kPmBlockHeaderBytes + std::uint64_t{block.bytes};
    if (header.has_attributes()) {
      if (at + kPmAttributesHeaderBytes > file.size()) break;
      const auto head = file.subspan(at, kPmAttributesHeaderBytes);
      at += kPmAttributesHeaderBytes + std::uint64_t{pm_parse_attributes(head).bytes};
    }
    const bool is_held = block.splits > 0 && block.splits <= kPmMostBlockSplits &&
                         block.bytes >= pm_least_bytes(block.splits) && at <= file.size();
    if (!is_held) break;
    splits += block.splits;
  }
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(splits, header.splits));
}

void PmReader::expect_splits(std::uint32_t splits) {
  state_->expected_splits = splits;
}

void PmReader::feed(std::span<const std::byte> bytes) {
  state_->feed(bytes);
}

void PmReader::finish() {
  State& s = *state_;
  const std::uint64_t end = s.used_bytes + s.waiting.size();
  if (!s.has_base && s.stage != Stage::damaged) {
    s.refuse(end, "the file ends within its header or base mesh");
  }
  if (s.stage == Stage::block) s.end_early(end, "the file ends early");
}

bool PmReader::has_base() const {
  return state_->has_base;
}
bool PmReader::is_complete() const {
  return state_->has_base && state_->mesh.split_count() == state_->header.splits;
}
std::string_view PmReader::damage() const {
  return state_->damage;
}
std::uint64_t PmReader::used_bytes() const {
  return state_->used_bytes;
}
std::uint32_t PmReader::announced_splits() const {
  return state_->header.splits;
}
unsigned PmReader::coordinate_bits() const {
  return state_->header.coordinate_bits;
}

ProgressiveMesh& PmReader::mesh() {
  MESHER_ASSERT(has_base());
  return state_->mesh;
}

ProgressiveAttributes& PmReader::attributes() {
  MESHER_ASSERT(has_base());
  return state_->attributes;
}

std::span<const std::byte> PmReader::appendix() const {
  MESHER_ASSERT(has_base());
  return state_->appendix;
}

std::uint64_t PmReader::attribute_bytes() const {
  return state_->attribute_bytes;
}

ProgressiveAttributes PmReader::take_attributes() {
  MESHER_ASSERT(has_base());
  return std::move(state_->attributes);
}

ProgressiveMesh PmReader::take() && {
  MESHER_ASSERT(has_base());
  return std::move(state_->mesh);
}

}  // namespace mesher::progressive
