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
                            "kernel gradients are kept until two particles may have moved EPS h towards each "
                            "other; 0 works them out in every step. Needs HMIN = HMAX = 1",
                            {.check = Check::not_negative}}}}}}};

}  // namespace

}  // namespace courant
