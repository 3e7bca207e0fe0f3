#include "core/io/sha256.h"

#include <gtest/gtest.h>

#include "core/io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace fenestra {
namespace {

using testing::TemporaryFolder;

TEST(Sha256Test, GivesTheExamplesOfFips180) {
  const TemporaryFolder folder;
  EXPECT_EQ(Sha256OfFile(folder.Write("abc", "abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(Sha256OfFile(folder.Write("none", "")),
            "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(Sha256OfFile(folder.Write("million", std::string(1'000'000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(Sha256("abc"), Sha256OfFile(folder / "abc"));
  EXPECT_THROW(Sha256OfFile(folder / "missing"), InputError);
  EXPECT_THROW(Sha256OfFile(folder.path()), InputError);
}

}  // namespace
}  // namespace fenestra
