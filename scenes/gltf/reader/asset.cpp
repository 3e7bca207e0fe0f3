#include "scenes/gltf/reader/asset.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "core/io/faults.h"
#include "scenes/gltf/file/bytes.h"
#include "scenes/gltf/file/document.h"
#include "scenes/gltf/validation/extensions.h"
#include "scenes/gltf/validation/structure_check.h"

namespace fenestra::gltf {
namespace {

using nlohmann::json;

// tinygltf refuses indices whose accessor has no buffer view, though these are legal zeros. So they
// pass it by.
void TakeIndices(json& structure) {
  if (!structure.contains("meshes")) return;
  for (json& mesh : structure["meshes"]) {
    for (json& primitive : mesh["primitives"]) primitive.erase("indices");
  }
}

void RestoreIndices(const json& root, tinygltf::Model& model) {
  for (size_t i = 0; i < model.meshes.size(); ++i) {
    for (size_t k = 0; k < model.meshes[i].primitives.size(); ++k) {
      const json& primitive = root["meshes"][i]["primitives"][k];
      model.meshes[i].primitives[k].indices = primitive.value("indices", -1);
    }
  }
}

tinygltf::Model ParseStructure(const Document& document) {
  json structure = document.json;
  structure.erase("buffers");
  structure.erase("images");
  TakeIndices(structure);
  const std::string text = structure.dump();
  tinygltf::Model model;
  std::string errors;
  std::string warnings;
  tinygltf::TinyGLTF parser;
  if (!parser.LoadASCIIFromString(&model, &errors, &warnings, text.data(),
                                  static_cast<unsigned int>(text.size()), "")) {
    throw InputError(document.file, "tinygltf refuses it: " + errors);
  }
  RestoreIndices(document.json, model);
  return model;
}

std::vector<uint64_t> BufferLengths(const json& root) {
  std::vector<uint64_t> lengths;
  if (!root.contains("buffers")) return lengths;
  for (const json& buffer : root["buffers"]) lengths.push_back(buffer["byteLength"]);
  return lengths;
}

void CheckStructure(const Document& document, const tinygltf::Model& model) {
  Faults faults(document.file.string(), kMostFaults);
  CheckAccessors(model, BufferLengths(document.json), faults);
  CheckMeshes(model, faults);
  CheckNodes(model, document.json, faults);
  CheckSkins(model, faults);
  CheckInstancing(model, faults);
  CheckCamerasAndLights(document.json, faults);
  CheckAnimations(document.json, faults);
  faults.ThrowIfAny();
}

std::optional<Bytes> TryReadUri(const std::string& uri, const std::string& at,
                                const std::filesystem::path& folder, ByteBudget& budget,
                                Faults& faults) {
  constexpr size_t kMostShown = 80;  // A data URI may have a megabyte.
  try {
    return ReadUri(uri, folder, budget);
  } catch (const std::invalid_argument& error) {
    faults.Add(at + "/uri", fmt::format("'{}{}': {}", uri.substr(0, kMostShown),
                                        uri.size() > kMostShown ? "…" : "", error.what()));
  } catch (const InputError& error) {
    faults.Add(at + "/uri", error.what());
  }
  return std::nullopt;
}

void LoadBuffers(Document& document, Asset& asset, ByteBudget& budget, Faults& faults) {
  if (!document.json.contains("buffers")) return;
  const json& buffers = document.json["buffers"];
  for (size_t i = 0; i < buffers.size(); ++i) {
    const std::string at = fmt::format("/buffers/{}", i);
    std::optional<Bytes>& bytes = asset.buffers.emplace_back();
    if (buffers[i].contains("uri")) {
      bytes = TryReadUri(buffers[i]["uri"], at, document.file.parent_path(), budget, faults);
    } else if (i == 0) {
      bytes = std::move(document.binary_chunk);
    }
    const auto length = buffers[i]["byteLength"].get<size_t>();
    if (bytes && bytes->size() < length) {
      faults.Add(
          at, fmt::format("has {} bytes instead of the {} in 'byteLength'", bytes->size(), length));
    }
  }
}

std::optional<Bytes> BytesOfView(const Asset& asset, size_t index) {
  const tinygltf::BufferView& view = asset.model.bufferViews[index];
  const std::optional<Bytes>& buffer = asset.buffers[static_cast<size_t>(view.buffer)];
  if (!buffer) return std::nullopt;
  const auto begin = buffer->begin() + static_cast<std::ptrdiff_t>(view.byteOffset);
  return Bytes(begin, begin + static_cast<std::ptrdiff_t>(view.byteLength));
}

void LoadImages(const Document& document, Asset& asset, ByteBudget& budget, Faults& faults) {
  if (!document.json.contains("images")) return;
  const json& images = document.json["images"];
  for (size_t i = 0; i < images.size(); ++i) {
    const std::string at = fmt::format("/images/{}", i);
    Bytes& bytes = asset.images.emplace_back();
    const bool has_view = images[i].contains("bufferView");
    if (has_view == images[i].contains("uri")) {
      faults.Add(at, "must have either a 'uri' or a 'bufferView'");
      continue;
    }
    if (has_view) {
      if (!images[i].contains("mimeType")) faults.Add(at, "'mimeType' is missing");
      bytes = BytesOfView(asset, images[i]["bufferView"].get<size_t>()).value_or(Bytes());
      if (!budget.Take(bytes.size())) faults.Add(at, "more data than is read for one scene");
    } else {
      bytes = TryReadUri(images[i]["uri"], at, document.file.parent_path(), budget, faults)
                  .value_or(Bytes());
    }
  }
}

}  // namespace

void Notes::Add(std::string_view what, std::string thing) {
  auto found = std::ranges::find(things_by_what_, what,
                                 [](const auto& entry) { return std::string_view(entry.first); });
  if (found == things_by_what_.end()) {
    found = things_by_what_.insert(found, {std::string(what), {}});
  }
  std::vector<std::string>& things = found->second;
  if (things.empty() || things.back() != thing) things.push_back(std::move(thing));
}

std::vector<std::string> Notes::Sentences() const {
  constexpr size_t kMostNamed = 3;
  std::vector<std::string> sentences;
  for (const auto& [what, things] : things_by_what_) {
    const size_t named = std::min(things.size(), kMostNamed);
    std::string subject = fmt::format(
        "{}", fmt::join(things.begin(), things.begin() + static_cast<int>(named), ", "));
    if (things.size() > named) subject += fmt::format(" and {} more", things.size() - named);
    sentences.push_back(fmt::format("{}: {}", subject, what));
  }
  return sentences;
}

std::string Named(std::string_view kind, std::string_view name, size_t index) {
  return name.empty() ? fmt::format("{} {}", kind, index) : fmt::format("{} '{}'", kind, name);
}

Asset LoadAsset(const std::filesystem::path& file, const GltfReadOptions& options) {
  ByteBudget budget(options.max_file_bytes);
  Document document = ReadDocument(file, budget);
  Faults faults(file.string(), kMostFaults);
  CheckVersionAndExtensions(document.json, faults);
  faults.ThrowIfAny();
  CheckSchema(document.json, faults);
  faults.ThrowIfAny();
  Asset asset;
  asset.file = file;
  asset.model = ParseStructure(document);
  asset.ignored_extensions = IgnoredExtensions(document.json);
  CheckStructure(document, asset.model);
  LoadBuffers(document, asset, budget, faults);
  faults.ThrowIfAny();
  LoadImages(document, asset, budget, faults);
  faults.ThrowIfAny();
  return asset;
}

}  // namespace fenestra::gltf
