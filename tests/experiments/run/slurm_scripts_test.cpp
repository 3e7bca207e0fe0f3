#include "experiments/run/shards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using ::testing::HasSubstr;
using testing::ReadFile;
using ::testing::StartsWith;
using testing::TemporaryFolder;

/// The program is a script that notes its arguments, in a folder whose name needs quoting.
class SlurmScriptsTest : public ::testing::Test {
 protected:
  SlurmScriptsTest() {
    submission_.program = folder_.Write("it's a program", "#!/bin/bash\nprintf '<%s>' \"$@\" > " +
                                                              (folder_ / "noted").string() + "\n");
    std::filesystem::permissions(submission_.program, std::filesystem::perms::all);
    submission_.name = "tiny";
    submission_.study = "/in/two words/study.yaml";
    submission_.out = "/out/x y";
    submission_.shards = 3;
    submission_.jobs = 2;
  }

  std::string ArgumentsOf(const std::string& script) {
    const auto file = folder_.Write("script.sh", script);
    EXPECT_EQ(std::system(("SLURM_ARRAY_TASK_ID=2 bash " + file.string()).c_str()), 0);
    return ReadFile(folder_ / "noted");
  }

  TemporaryFolder folder_;
  SlurmSubmission submission_;
};

TEST_F(SlurmScriptsTest, ATaskRunsItsShard) {
  submission_.run_options = {"--seed=7"};
  EXPECT_EQ(ArgumentsOf(SlurmArrayScript(submission_)),
            "<run></in/two words/study.yaml><--seed=7><--jobs><2><--shard><2/3>"
            "<--out></out/x y/shards/2>");
}

TEST_F(SlurmScriptsTest, TheMergeNamesEveryShardSoThatALostOneIsNoticed) {
  EXPECT_EQ(ArgumentsOf(SlurmMergeScript(submission_)),
            "<merge></out/x y/shards/1></out/x y/shards/2></out/x y/shards/3><--out></out/x y>");
}

TEST_F(SlurmScriptsTest, DirectivesComeFirst) {
  submission_.sbatch_options = {"--time=1:00:00"};
  const std::string script = SlurmArrayScript(submission_);
  EXPECT_THAT(script, StartsWith("#!/bin/bash\n#SBATCH --job-name=fenestra-tiny\n"));
  for (const char* option : {"--array=1-3", "--requeue", "--cpus-per-task=2", "--time=1:00:00",
                             "--open-mode=append", "--output='/out/x y/slurm/shard-%a.log'"}) {
    EXPECT_THAT(script, HasSubstr(std::string("#SBATCH ") + option + "\n"));
    EXPECT_LT(script.find(option), script.find("exec "));
  }
}

TEST_F(SlurmScriptsTest, AFolderWithAPercentSignIsNoPattern) {
  submission_.out = "/out/50 % %j";
  EXPECT_THAT(SlurmArrayScript(submission_),
              HasSubstr("#SBATCH --output='/out/50 %% %%j/slurm/shard-%a.log'\n"));
  EXPECT_THAT(SlurmMergeScript(submission_), HasSubstr("%%j/slurm/merge.log'\n"));
  // In the commands the shell reads it as it is.
  EXPECT_THAT(ArgumentsOf(SlurmMergeScript(submission_)), HasSubstr("<--out></out/50 % %j>"));
}

}  // namespace
}  // namespace fenestra
