#include "tests/experiments/cli/writing_commands.h"

#include <utility>

#include "tests/experiments/cli/program.h"

namespace fenestra::testing {

const std::vector<WritingCommand>& WritingCommands() {
  static const std::vector<WritingCommand> commands = {
      {"run",
       "run WORK/tiny.yaml --out OUT --restart",
       {"study.yaml", "trials.csv", "summary.csv", "summary.md", "intervals.csv",
        "results.sqlite"}},
      {"merge",
       "merge WORK/shard --out OUT --restart",
       {"study.yaml", "trials.csv", "summary.csv", "summary.md", "intervals.csv",
        "results.sqlite"}},
      {"check", "check WORK/limits.yaml --out OUT", {"study.yaml", "summary.md", "results.sqlite"}},
      {"report",
       "report WORK/result --out OUT --pictures",
       {"study.yaml", "trials.csv", "summary.csv", "summary.md", "intervals.csv"}},
      {"score",
       "score WORK/sequence/sequence_with_detectors.yaml --out OUT --restart",
       {"trials.csv", "summary.csv", "summary.md", "results.sqlite"}},
      {"render_trial",
       "render WORK/tiny.yaml --out OUT",
       {"left.png", "calibration.yaml", "truth/truth.json"}},
      {"render_sequence",
       "render WORK/tiny.yaml --sequence stereo --out OUT",
       {"sequence.yaml", "00000/left.png"}},
      {"replay",
       "replay WORK/result 0/0 --out OUT",
       {"left.png", "calibration.yaml", "truth/trial.yaml"}},
      {"emva",
       "emva OUT --exposures 10 --frames 16 --width-px 64 --height-px 48",
       {"report.md", "results.json", "photon_transfer.png", "emva1288.txt"}},
      {"depth", "depth OUT", {"depth_curves.md", "depth_curves.png"}, false},
      {"validate",
       "validate --recordings " FENESTRA_SOURCE_DIR "/tests/data --out OUT",
       {"validation.md"},
       false},
      {"calibrate",
       "calibrate stereo --left WORK/sequence/00000/left.png --right "
       "WORK/sequence/00000/right.png --corners 9x6 --square-mm 30 --out OUT",
       {"stereo.yaml", "report.md", "residuals.png"},
       false},
      {"submit",
       "submit WORK/tiny.yaml --slurm --shards 2 --out OUT",
       {"slurm/study.yaml", "slurm/array.sh", "slurm/merge.sh"},
       false},
      {"detect",
       "detect stereo --left WORK/sequence/00000/left.png --right "
       "WORK/sequence/00000/right.png "
       "--calibration WORK/sequence/00000/calibration.yaml --detector edge-stereo --pictures OUT",
       {"2_segments.png"}}};
  return commands;
}

TemporaryFolder* WritingCommandsTest::work_ = nullptr;

void WritingCommandsTest::SetUpTestSuite() {
  work_ = new TemporaryFolder;
  work_->Write("tiny.yaml", kTinyStudy);
  work_->Write("limits.yaml", "study: tiny.yaml\nlimits: [rate(hit) >= 0.1]\n");
  for (const char* command : {"run WORK/tiny.yaml --no-pictures --out WORK/result",
                              "run WORK/tiny.yaml --no-pictures --shard 1/1 --out WORK/shard",
                              "render WORK/tiny.yaml --sequence stereo --out WORK/sequence"}) {
    const ProgramOutput output = Fenestra(Placed(command, ""));
    ASSERT_EQ(output.exit_code, 0) << command << output.text;
  }
  work_->Write("sequence/sequence_with_detectors.yaml",
               ReadFile(*work_ / "sequence/sequence.yaml") + "detectors: [edge-stereo]\n");
}

void WritingCommandsTest::TearDownTestSuite() {
  delete std::exchange(work_, nullptr);
}

std::string WritingCommandsTest::Placed(std::string text, const std::filesystem::path& out) {
  for (const auto& [word, path] : {std::pair("WORK", work_->path()), std::pair("OUT", out)}) {
    for (size_t at = text.find(word); at != std::string::npos; at = text.find(word)) {
      text.replace(at, std::string(word).size(), path.string());
    }
  }
  return text;
}

}  // namespace fenestra::testing
