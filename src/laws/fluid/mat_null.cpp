#include "laws/fluid/mat_null.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<MatNull> mat_null{
    {.names = {"MAT_NULL", "MAT_009"},
     .purpose = "fluid: density, tensile cut-off and viscosity; pressure comes from the part's EOS",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &MatNull::title,
     .cards = {
         {.fields = {
              {"MID",
               &MatNull::mid,
               "-",
               "id that *PART refers to",
               {.required = true, .check = Check::positive}},
              {"RO", &MatNull::ro, "M/L3", "reference density", {.required = true, .check = Check::positive}},
              {"PC",
               &MatNull::pc,
               "M/LT2",
               "tensile pressure cut-off; 0 allows no tension",
               {.check = Check::not_positive}},
              {"MU", &MatNull::mu, "M/LT", "dynamic viscosity", {.check = Check::not_negative}},
              {"TEROD", &MatNull::terod, "-", "erosion in expansion", unsupported},
              {"CEROD", &MatNull::cerod, "-", "erosion in compression", unsupported},
              {"YM", &MatNull::ym, "M/LT2", "Young's modulus of null shells and beams", no_effect},
              {"PR", &MatNull::pr, "-", "Poisson ratio of null shells and beams", no_effect}}}}}};

}  // namespace

}  // namespace courant
