#include "src/parameter/table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rastertlm::parameter {
namespace {

enum class Colour { red, green };

struct Part {
  std::int64_t size = 3;
  void declare(Table& table) {
    table.integer("size", size, {0, 10}, {.unit = "", .description = "Size.", .moves = "x"});
  }
};

struct Whole {
  Colour colour = Colour::green;
  bool lit = false;
  double level = 0.5;
  double deep = 1.0;
  Triple at{1, 2, 3};
  std::vector<Part> parts;
  void declare(Table& table) {
    table.choice("colour", colour, {"red", "green"}, {.unit = "", .description = "Colour.", .moves = "picture"});
    table.boolean("lit", lit,
                  {.unit = "", .description = "Lit.", .moves = "picture", .only_when = Condition{"colour", {"red"}}});
    table.real("level", level, {0.0, 1.0},
               {.unit = "", .description = "Level.", .moves = "picture", .only_when = Condition{"lit", {"true"}}});
    table.real("deep", deep, {0.0, 1.0, true}, {.unit = "m", .description = "Depth.", .moves = "picture"});
    table.triple("at", at, {-1.0, 9.0}, {.unit = "", .description = "Place.", .moves = "picture"});
    table.list("part", parts, "Parts.");
  }
};

TEST(Table, IsAViewOfALiveStructure) {
  Whole whole;
  const Table table = view(whole);
  table.find("deep")->set(0.25);
  table.find("colour")->set(std::string("red"));
  table.find("at")->set(Triple{4, 5, 6});
  EXPECT_EQ(whole.deep, 0.25);
  EXPECT_EQ(whole.colour, Colour::red);
  EXPECT_EQ(whole.at, (Triple{4, 5, 6}));
  whole.deep = 0.75;
  EXPECT_EQ(std::get<double>(table.find("deep")->get()), 0.75);
  EXPECT_EQ(std::get<double>(table.find("deep")->default_value), 1.0);
  EXPECT_EQ(std::get<std::string>(table.find("colour")->default_value), "green");
  EXPECT_THAT(table.find("colour")->choices, testing::ElementsAre("red", "green"));
  EXPECT_TRUE(table.find("deep")->range->above_minimum);
  EXPECT_EQ(table.find("nothing"), nullptr);
  EXPECT_EQ(table.find("part"), nullptr);
}

TEST(Table, ListsGrowAndShrink) {
  Whole whole;
  const Table table = view(whole);
  const List* list = table.find_list("part");
  ASSERT_NE(list, nullptr);
  EXPECT_EQ(table.find_list("deep"), nullptr);
  list->append().find("size")->set(std::int64_t{7});
  list->append();
  ASSERT_EQ(list->size(), 2U);
  EXPECT_EQ(whole.parts[0].size, 7);
  list->element(1).find("size")->set(std::int64_t{9});
  EXPECT_EQ(whole.parts[1].size, 9);
  EXPECT_EQ(std::get<std::int64_t>(list->example().find("size")->get()), 3);
  list->clear();
  EXPECT_TRUE(whole.parts.empty());
}

TEST(Table, AParameterAppliesWhereAllItsChoicesDo) {
  Whole whole;
  const Table table = view(whole);
  const auto applies = [&](const char* path) { return table.applies(*table.find(path)); };
  EXPECT_TRUE(applies("deep"));
  EXPECT_FALSE(applies("lit"));
  whole.lit = true;
  EXPECT_FALSE(applies("level"));
  EXPECT_EQ(table.unmet_condition(*table.find("level"))->path, "colour");
  whole.colour = Colour::red;
  EXPECT_TRUE(applies("lit"));
  EXPECT_TRUE(applies("level"));
  whole.lit = false;
  EXPECT_EQ(table.unmet_condition(*table.find("level"))->path, "lit");
}

}  // namespace
}  // namespace rastertlm::parameter
