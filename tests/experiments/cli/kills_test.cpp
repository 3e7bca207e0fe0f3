// A run that is killed again and again while others read its result, write into its folder and use
// its place for temporary files. FENESTRA_KILLS says how often; many find more than few.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <sstream>

#include "experiments/report/report.h"
#include "experiments/store/store.h"
#include "tests/experiments/cli/program.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::ElementsAre;
using testing::ReadFile;
using testing::TemporaryFolder;

constexpr const char* kStudy =
    "name: kills\nrepetitions: 30\nsensors: [stereo]\n"
    "detectors: [{name: edge-stereo, isolate: true}]\n"
    "factors: {distance_m: [2, 3]}\n";
constexpr const char* kOtherStudy =
    "name: other\nrepetitions: 1\nsensors: [stereo]\ndetectors: [edge-stereo]\n"
    "factors: {distance_m: 2}\n";

// In the folder, with the program and the number of kills. What each of the others says goes into a
// file of its own, with a line "exit code N" behind every call.
constexpr const char* kScript = R"sh(
cd "$1"; fenestra=$2; kills=$3
run=("$fenestra" run kills.yaml --no-pictures --jobs 2 --out out)
kill_after() {
  "${run[@]}" >> killed 2>&1 & local process=$!
  "${@}"; kill -9 $process; wait $process 2> /dev/null
}
again() {
  local said=$1; shift
  while [ ! -e stop ]; do "$@" >> "$said" 2>&1; echo "exit code $?" >> "$said"; sleep 0.05; done
}
begun() { while [ ! -e out/results.sqlite ]; do sleep 0.01; done; }
kill_after begun
detect=("$fenestra" detect stereo --left frames/00000/left.png --right frames/00000/right.png
        --calibration frames/00000/calibration.yaml --command "[$fenestra, serve, edge-stereo]")
# Where it is possible, among other process numbers.
unshare -fp --mount-proc true 2> /dev/null && detect=(unshare -fp --mount-proc "${detect[@]}")
again reader "$fenestra" pool out --by distance_m &
again writer "$fenestra" run other.yaml --no-pictures --out out &
again container "${detect[@]}" &
RANDOM=7
for ((i = 0; i < kills; ++i)); do kill_after sleep "$(printf '0.%03d' $((RANDOM % 1000)))"; done
touch stop; wait
"${run[@]}" > last 2>&1
)sh";

// All that a row holds but its times.
std::string RowsWithoutTimes(const std::filesystem::path& out) {
  std::vector<TrialRecord> rows = ResultStore::OpenReadOnly(out / "results.sqlite").Rows();
  for (TrialRecord& row : rows) row.stages.clear();
  return TrialsCsv(rows);
}

std::set<std::string> ExitCodes(const std::filesystem::path& said) {
  std::set<std::string> codes;
  std::istringstream lines(ReadFile(said));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("exit code")) codes.insert(line);
  }
  return codes;
}

TEST(KillsTest, LoseNothingWhileOthersReadAndWriteBesides) {
  const TemporaryFolder folder;
  folder.Write("kills.yaml", kStudy);
  folder.Write("other.yaml", kOtherStudy);
  const std::string in = folder.path().string() + "/";
  for (const std::string& command :
       {"run " + in + "kills.yaml --no-pictures --out " + in + "whole",
        "render " + in + "other.yaml --sequence stereo --out " + in + "frames"}) {
    ASSERT_EQ(Fenestra(command).exit_code, 0) << command;
  }
  const char* const kills = std::getenv("FENESTRA_KILLS");
  const std::string script = "bash " + folder.Write("script.sh", kScript).string() + " " + in +
                             " " + FENESTRA_PROGRAM + " " + (kills != nullptr ? kills : "4");
  EXPECT_EQ(std::system(script.c_str()), 0) << ReadFile(folder / "last");
  EXPECT_EQ(RowsWithoutTimes(folder / "out"), RowsWithoutTimes(folder / "whole"));
  EXPECT_THAT(ExitCodes(folder / "reader"), ElementsAre("exit code 0"));
  EXPECT_THAT(ExitCodes(folder / "writer"), ElementsAre("exit code 2"));
  EXPECT_THAT(ExitCodes(folder / "container"), ElementsAre("exit code 0"));
}

}  // namespace
}  // namespace fenestra
