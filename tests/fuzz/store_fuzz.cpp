#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>

#include "core/io/input_error.h"
#include "experiments/run/result_files.h"

// A libFuzzer target: whatever a result folder's files hold, they are read and reported, recovered,
// or refused with an InputError. Bytes that begin as a journal of SQLite's are that of the sound
// store among the seeds, as a run that was killed leaves one; all others are the store itself.

namespace {

namespace fs = std::filesystem;

constexpr std::array<uint8_t, 8> kJournal = {0xd9, 0xd5, 0x05, 0xf9, 0x20, 0xa1, 0x63, 0xd7};

void Write(const fs::path& file, const uint8_t* data, size_t size) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
}

fs::path FolderWith(const uint8_t* data, size_t size) {
  const fs::path folder = fs::temp_directory_path() / ("fenestra-fuzz-" + std::to_string(getpid()));
  const fs::path store = folder / "results.sqlite";
  const fs::path journal = folder / "results.sqlite-journal";
  fs::create_directories(folder);
  fs::remove(journal);
  if (size >= kJournal.size() && std::equal(kJournal.begin(), kJournal.end(), data)) {
    fs::copy_file(FENESTRA_SOURCE_DIR "/tests/fuzz/seeds/store/small.sqlite", store,
                  fs::copy_options::overwrite_existing);
    Write(journal, data, size);
  } else {
    Write(store, data, size);
  }
  return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fs::path folder = FolderWith(data, size);
  try {
    const auto store = fenestra::ResultStore::OpenReadOnly(folder / "results.sqlite");
    store.FinishedTrials();
    store.Tallies();
    store.Runs();
    const fenestra::Study study = fenestra::StudyOf(store, folder / "results.sqlite");
    fenestra::WriteResultFiles(store, study, fenestra::Cells(study),
                               fenestra::OutputPath::Folder(folder));
  } catch (const fenestra::InputError&) {
  }
  return 0;
}
