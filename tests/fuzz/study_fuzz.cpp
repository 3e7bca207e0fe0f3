#include <string>

#include "core/io/input_error.h"
#include "experiments/sequence/sequence.h"
#include "experiments/study_file/study_reader.h"
#include "tests/fuzz/input_file.h"

// A libFuzzer target: any bytes at all are a study or a sequence, or an InputError.

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::filesystem::path file = fenestra::InputFile(data, size, ".yaml");
  try {
    fenestra::ReadStudyFile(file, fenestra::Detectors());
  } catch (const fenestra::InputError&) {
  }
  try {
    fenestra::ReadSequence(file);
  } catch (const fenestra::InputError&) {
  }
  return 0;
}
