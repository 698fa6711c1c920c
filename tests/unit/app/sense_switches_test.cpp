#include "app/run/sense_switches.hpp"

#include <gtest/gtest.h>

#include <fstream>

namespace courant {
namespace {

using Kind = SenseSwitch::Kind;

TEST(SenseSwitches, AreReadAsLsDynaWritesThem) {
  const std::pair<const char*, Kind> known[] = {
      {"sw1.", Kind::dump_and_stop}, {"SW1.\n", Kind::dump_and_stop}, {"sw1", Kind::dump_and_stop},
      {"sw2.", Kind::tell},          {"sw3. now", Kind::dump},        {" sw4.", Kind::plot},
      {"swa.", Kind::flush},         {"swd.", Kind::dump_and_stop},   {"stop", Kind::stop},
      {"quit", Kind::stop},          {"endtime=0.25", Kind::end_time}};
  for (const auto& [text, kind] : known) {
    const auto order = sense_switch_of(text);
    ASSERT_TRUE(order.has_value()) << text;
    EXPECT_EQ(order->kind, kind) << text;
  }
  EXPECT_EQ(sense_switch_of("endtime=0.25")->end_time, 0.25);
  for (const char* text : {"sw9.", "sw", "endtime=", "endtime=-1", "endtime=2x", "1"})
    EXPECT_EQ(sense_switch_of(text)->kind, Kind::unknown) << text;
  for (const char* text : {"", " \n", "\n"}) EXPECT_FALSE(sense_switch_of(text)) << "only blanks";
}

TEST(SenseSwitches, AFileActsOnce) {
  const auto dir = std::filesystem::path(testing::TempDir()) / "sense_switches";
  std::filesystem::create_directories(dir);
  std::ofstream(dir / "d3kil") << "sw2.\n";
  SenseSwitches switches(dir, false);
  const auto order = switches.take();
  ASSERT_TRUE(order.has_value());
  EXPECT_EQ(order->text, "sw2.");
  EXPECT_FALSE(std::filesystem::exists(dir / "d3kil"));
  EXPECT_FALSE(switches.take());
  std::filesystem::remove_all(dir);
}

}  // namespace
}  // namespace courant
