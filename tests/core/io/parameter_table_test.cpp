#include "core/io/parameter_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

namespace fenestra {
namespace {

using ::testing::HasSubstr;

enum class Finish { kPlaster, kBrick };

struct Settings {
  double angle_rad = std::numbers::pi / 2;
  int size_px = 15;
  bool glass = true;
  std::string scene = "facade";
  Finish finish = Finish::kBrick;
};

ParameterTable<Settings> Table() {
  ParameterTable<Settings> table;
  table
      .Number("angle_deg", FENESTRA_FIELD(angle_rad),
              {.min = -180.0, .max = 180.0, .si_per_unit = std::numbers::pi / 180.0}, "An angle.")
      .Integer("size_px", FENESTRA_FIELD(size_px), {.min = 1, .max = 99}, "A size.")
      .Switch("glass", FENESTRA_FIELD(glass), "A pane.")
      .Choice("scene", FENESTRA_FIELD(scene), {"facade", "wall"}, "A scene.")
      .Choice("finish", FENESTRA_FIELD(finish), {"plaster", "brick"}, "A finish.");
  return table;
}

TEST(ParameterTableTest, NamesCarryTheUnitAndFieldsAreSi) {
  const ParameterTable<Settings> table = Table();
  Settings settings;
  EXPECT_DOUBLE_EQ(std::get<double>(table.Get(settings, "angle_deg")), 90.0);
  table.Set(settings, "angle_deg", 45.0);
  EXPECT_DOUBLE_EQ(settings.angle_rad, std::numbers::pi / 4);
}

TEST(ParameterTableTest, DefaultsAreThoseOfTheStruct) {
  const ParameterTable<Settings> table = Table();
  EXPECT_EQ(table.Find("size_px")->default_value, ParameterValue(15.0));
  EXPECT_EQ(table.Find("scene")->default_value, ParameterValue(std::string("facade")));
}

TEST(ParameterTableTest, EnumerationsAreSetByTheirNames) {
  const ParameterTable<Settings> table = Table();
  Settings settings;
  EXPECT_EQ(table.Get(settings, "finish"), ParameterValue(std::string("brick")));
  table.Set(settings, "finish", std::string("plaster"));
  EXPECT_EQ(settings.finish, Finish::kPlaster);
  EXPECT_THAT(*table.Find("finish")->Objection(std::string("brik")),
              HasSubstr("Did you mean 'brick'?"));
}

TEST(ParameterTableTest, ObjectionsSayWhatIsAllowed) {
  const ParameterTable<Settings> table = Table();
  EXPECT_THAT(*table.Find("angle_deg")->Objection(200.0), HasSubstr("from -180 to 180, not '200'"));
  EXPECT_THAT(*table.Find("size_px")->Objection(1.5), HasSubstr("a whole number from 1 to 99"));
  EXPECT_THAT(*table.Find("glass")->Objection(1.0), HasSubstr("true or false"));
  EXPECT_THAT(*table.Find("scene")->Objection(std::string("facde")),
              HasSubstr("Did you mean 'facade'?"));
  EXPECT_FALSE(table.Find("scene")->Objection(std::string("wall")));
}

TEST(ParameterTableTest, ReadingNotesFaultsWithTheirPlace) {
  const ParameterTable<Settings> table = Table();
  YamlReader reader = YamlReader::FromText("size_px: -3\nglass: yes\n", "f");
  EXPECT_FALSE(table.Find("size_px")->Read(reader, reader.root()["size_px"]));
  EXPECT_FALSE(table.Find("glass")->Read(reader, reader.root()["glass"]));
  try {
    reader.ThrowIfFaulty();
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults()[0].line, 1);
    EXPECT_EQ(error.faults()[0].column, 10);
    EXPECT_EQ(error.faults()[1].line, 2);
  }
}

}  // namespace
}  // namespace fenestra
