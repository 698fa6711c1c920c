// *MAT_LINEAR_ELASTIC_DISCRETE_BEAM
#include "elements/beam/discrete_beam_law.hpp"
#include "keyword/common_rules.hpp"

namespace courant {

namespace {

struct LinearElasticBeam : Entry {
  std::string title;
  Id mid = 0;
  Real ro = 0;
  Real tkr = 0, tks = 0, tkt = 0, rkr = 0, rks = 0, rkt = 0;
  Real tdr = 0, tds = 0, tdt = 0, rdr = 0, rds = 0, rdt = 0;
  Real for_ = 0, fos = 0, fot = 0, mor = 0, mos = 0, mot = 0;

  std::shared_ptr<DiscreteBeamLaw> law(const Deck&, const Model&, Diagnostics&) const {
    auto out = std::make_shared<DiscreteBeamLaw>();
    out->ro = ro;
    const SixOfBeam k{tkr, tks, tkt, rkr, rks, rkt}, c{tdr, tds, tdt, rdr, rds, rdt},
        start{for_, fos, fot, mor, mos, mot};
    for (std::size_t d = 0; d < 6; ++d)
      out->springs[d].k = k[d], out->springs[d].c = c[d], out->springs[d].preload = start[d];
    return out;
  }
};

const RegisterDiscreteBeam<LinearElasticBeam> mat_linear_elastic_discrete_beam{
    {.names = {"MAT_LINEAR_ELASTIC_DISCRETE_BEAM", "MAT_066"},
     .purpose = "six linear springs and dampers between the ends of beams with ELFORM 6",
     .id_space = IdSpace::material,
     .title_option = true,
     .title = &LinearElasticBeam::title,
     .cards = {
         {.fields = {{"MID", &LinearElasticBeam::mid, "-", "id that *PART refers to", rules::required_id},
                     {"RO", &LinearElasticBeam::ro, "M/L3", "density, of VOL of *SECTION_BEAM",
                      rules::required_positive},
                     {"TKR", &LinearElasticBeam::tkr, "M/T2", "stiffness along r", beam_at_least_0},
                     {"TKS", &LinearElasticBeam::tks, "M/T2", "along s", beam_at_least_0},
                     {"TKT", &LinearElasticBeam::tkt, "M/T2", "along t", beam_at_least_0},
                     {"RKR", &LinearElasticBeam::rkr, "ML2/T2", "stiffness about r, moment per radian",
                      beam_at_least_0},
                     {"RKS", &LinearElasticBeam::rks, "ML2/T2", "about s", beam_at_least_0},
                     {"RKT", &LinearElasticBeam::rkt, "ML2/T2", "about t", beam_at_least_0}}},
         {.fields = {{"TDR", &LinearElasticBeam::tdr, "M/T", "damping along r", beam_at_least_0},
                     {"TDS", &LinearElasticBeam::tds, "M/T", "along s", beam_at_least_0},
                     {"TDT", &LinearElasticBeam::tdt, "M/T", "along t", beam_at_least_0},
                     {"RDR", &LinearElasticBeam::rdr, "ML2/T", "damping about r", beam_at_least_0},
                     {"RDS", &LinearElasticBeam::rds, "ML2/T", "about s", beam_at_least_0},
                     {"RDT", &LinearElasticBeam::rdt, "ML2/T", "about t", beam_at_least_0}}},
         {.fields = {{"FOR", &LinearElasticBeam::for_, "ML/T2",
                      "force along r without displacement, > 0 pulls"},
                     {"FOS", &LinearElasticBeam::fos, "ML/T2", "along s"},
                     {"FOT", &LinearElasticBeam::fot, "ML/T2", "along t"},
                     {"MOR", &LinearElasticBeam::mor, "ML2/T2", "moment about r without rotation"},
                     {"MOS", &LinearElasticBeam::mos, "ML2/T2", "about s"},
                     {"MOT", &LinearElasticBeam::mot, "ML2/T2", "about t"}},
          .optional = true}}}};

}  // namespace

}  // namespace courant
