#include "core/io/file_name.h"

#include <gtest/gtest.h>

namespace fenestra {
namespace {

TEST(FileNameTest, ExtensionsAreComparedInLowerCase) {
  EXPECT_EQ(LowerExtension("a/View.PNG"), ".png");
  EXPECT_EQ(LowerExtension("a.b/scene.Glb"), ".glb");
  EXPECT_EQ(LowerExtension("a.PNG/none"), "");
}

TEST(FileNameTest, HiddenIsTheFileAndNotItsFolder) {
  EXPECT_TRUE(IsHidden("pictures/._left1.png"));
  EXPECT_FALSE(IsHidden(".pictures/left1.png"));
}

}  // namespace
}  // namespace fenestra
