#include "engine/io/image_decode.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/io/child_batch.h"
#include "engine/io/image_header.h"
#include "engine/io/shared_memory.h"

namespace mesher::io {
namespace {

/// Memory of images that are decoded at the same time, unless a single one takes more.
constexpr std::size_t kMostBytesAtOnce = std::size_t{256} << 20U;

/// An image that is to be decoded.
struct DecodeJob {
  std::size_t number = 0;  ///< among those that were asked for
  std::string_view bytes;
  ImageHeader header;
  std::uint32_t halved = 0;  ///< how often its sides are
  std::size_t offset = 0;    ///< of its pixels in the memory of its batch

  std::size_t pixel_bytes() const { return header.pixel_bytes() >> 2 * halved; }
};

std::string size_problem() {
  return fmt::format("is damaged, or larger than {0} x {0} pixels", kMostImageSide);
}

/// Returns why an image cannot be decoded, by its header; empty if it may.
std::string problem_of(const EncodedImage& image, const ImageHeader& header) {
  if (header.coding == ImageCoding::unknown) {
    const std::string& type = image.mime_type;
    const bool is_known =
        type == "image/png" || type == "image/jpeg" || type == "image/webp" || type.empty();
    return is_known ? "is not PNG, JPEG or WebP" : fmt::format("no decoder for {}", type);
  }
  const auto [least, most] = std::minmax(header.width, header.height);
  const bool fits =
      least > 0 && most <= kMostImageSide &&
      header.pixel_bytes() <= kAlwaysImageBytes + kMostImageBytesPerByte * image.bytes->size();
  return fits ? "" : size_problem();
}

std::string label_of(const Materials& materials, std::uint32_t index) {
  if (index < materials.images.size()) {
    const EncodedImage& image = materials.images[index];
    if (!image.path.empty()) return image.path.string();
    if (!image.name.empty()) return image.name;
  }
  return fmt::format("image {}", index);
}

class ImageDecoder {
 public:
  ImageDecoder(const Materials& materials, std::span<const ImageRequest> requests,
               const TakeImage& take, const DecodePixels& decode)
      : materials_(materials),
        requests_(requests),
        take_(take),
        decode_(decode),
        problems_(requests.size()) {}

  void run(Progress* progress) {
    std::vector<DecodeJob> batch;
    std::size_t batch_bytes = 0;
    for (const DecodeJob& job : jobs()) {
      const std::size_t bytes = job.pixel_bytes();
      if (!batch.empty() && batch_bytes + bytes > kMostBytesAtOnce) {
        decode_batch(batch, batch_bytes, progress);
        batch.clear();
        batch_bytes = 0;
      }
      batch.push_back(job);
      batch.back().offset = batch_bytes;
      batch_bytes += bytes;
    }
    if (!batch.empty()) decode_batch(batch, batch_bytes, progress);
  }

  std::vector<std::string> problem_lines() const {
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < requests_.size(); ++i) {
      if (problems_[i].empty()) continue;
      lines.push_back(fmt::format("texture '{}' is drawn white: {}",
                                  label_of(materials_, requests_[i].image), problems_[i]));
    }
    return lines;
  }

 private:
  /// Returns the images whose headers are good.
  std::vector<DecodeJob> jobs() {
    std::vector<DecodeJob> jobs;
    std::size_t pixel_bytes = 0;
    for (std::size_t i = 0; i < requests_.size(); ++i) {
      const std::uint32_t index = requests_[i].image;
      if (index >= materials_.images.size()) {
        problems_[i] = "there is no such image";
        continue;
      }
      const EncodedImage& image = materials_.images[index];
      if (!image.bytes) {
        problems_[i] = "its file is missing or outside the model's folder";
        continue;
      }
      const ImageHeader header = read_image_header(*image.bytes);
      problems_[i] = problem_of(image, header);
      if (!problems_[i].empty()) continue;
      const DecodeJob job{
          .number = i,
          .bytes = *image.bytes,
          .header = header,
          .halved = std::min(halvings(header.width, header.height, requests_[i].needed_side),
                             most_halvings(header.coding))};
      if (pixel_bytes + job.pixel_bytes() > kMostPixelBytesOfModel) {
        problems_[i] = "the others take 2 GB";
        continue;
      }
      pixel_bytes += job.pixel_bytes();
      jobs.push_back(job);
    }
    return jobs;
  }

  void decode_batch(std::span<const DecodeJob> batch, std::size_t bytes, Progress* progress) {
    const SharedMemory memory(bytes);
    std::size_t largest = 0;
    for (const DecodeJob& job : batch)
      largest = std::max(largest, job.header.pixel_bytes());
    // Progressive JPEG and WebP keep some bytes per pixel beside the picture.
    const ChildLimits limits{.memory = 4 * largest + (std::size_t{256} << 20U), .cpu_s = 60};
    const ChildTasks tasks{.count = batch.size(),
                           .work =
                               [&](std::size_t i) {
                                 const DecodeJob& job = batch[i];
                                 return decode_(job.header, job.bytes, job.halved,
                                                {memory.data() + job.offset, job.pixel_bytes()});
                               },
                           .finished =
                               [&](std::size_t i, ChildOutcome outcome) {
                                 const DecodeJob& job = batch[i];
                                 finish(job, outcome, memory.data() + job.offset);
                               }};
    run_in_children(tasks, limits, progress);
  }

  void finish(const DecodeJob& job, ChildOutcome outcome, const std::uint8_t* pixels) {
    if (outcome == ChildOutcome::done) {
      take_(job.number, {job.header.width >> job.halved, job.header.height >> job.halved, pixels});
    } else {
      problems_[job.number] = outcome == ChildOutcome::died
                                  ? "it crashes its decoder, or takes too long"
                                  : size_problem();
    }
  }

  const Materials& materials_;
  std::span<const ImageRequest> requests_;
  const TakeImage& take_;
  const DecodePixels& decode_;
  std::vector<std::string> problems_;  ///< of each image; empty: none
};

}  // namespace

void decode_images(const Materials& materials, std::span<const ImageRequest> requests,
                   const TakeImage& take, std::vector<std::string>& problems, Progress* progress,
                   const DecodePixels& decode) {
  ImageDecoder decoder(materials, requests, take, decode);
  decoder.run(progress);
  for (std::string& line : decoder.problem_lines())
    problems.push_back(std::move(line));
}

}  // namespace mesher::io
