// What a big scene may take: per particle, and nothing of the deck once the run is built.
#include "model/cards.hpp"
#include "scenes.hpp"

using namespace courant;
using courant::test::simulation;

namespace {

/// Coarse, because bytes per particle do not depend on how many there are.
const std::map<std::string, std::string> coarse = {{"dx", "0.05"}};

}  // namespace

// 400 is the goal for all but the lists of neighbours; what is built beside the fields shares it.
TEST(Memory, FieldsTakeAtMost300BytesPerParticleIn3D) {
  for (const char* iavis : {"0", "1"}) {
    auto parameters = coarse;
    parameters["iavis"] = iavis;
    const auto s = simulation("dam_break_3d", parameters);
    ASSERT_NE(s, nullptr);
    ASSERT_EQ(s->contacts().size(), 1u);
    const FieldSet& fields = s->world().particles.fields;
    EXPECT_LE(fields.bytes_per_entity(), 300u) << "IAVIS " << iavis;
  }
}

TEST(Memory, TablesOfTheDeckAreGivenBackOnceTheWorldIsBuilt) {
  const auto s = simulation("dam_break_3d", coarse);
  ASSERT_NE(s, nullptr);
  EXPECT_EQ(s->world().particles.size(), 8 * 4 * 4);
  EXPECT_EQ(s->model().nodes.capacity(), 0u);
  EXPECT_EQ(s->model().sph.capacity(), 0u);
  EXPECT_TRUE(s->deck().all<NodeCard>().empty());
  EXPECT_TRUE(s->deck().all<ElementSphCard>().empty());
  for (const DeckFile& file : s->deck().files) EXPECT_EQ(file.source, nullptr);
  EXPECT_FALSE(s->deck().files.empty()) << "names stay, for `courant check`";
}
