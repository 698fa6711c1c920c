#include "keyword/registry.hpp"
#include "sph/cards.hpp"

namespace courant {

namespace {

const RegisterKeyword<CourantPairGeometry> pair_geometry{
    {.names = {"COURANT_PAIR_GEOMETRY"},
     .purpose = "keep kernel gradients over several steps where sound is much faster than the flow",
     .once = true,
     .many = false,
     .cards = {{.fields = {{"EPS",
                            &CourantPairGeometry::eps,
                            "-",
                            "relative motion, in h, over which kernel gradients are frozen; 0: none",
                            {.check = Check::not_negative}}}}}}};

}  // namespace

}  // namespace courant
