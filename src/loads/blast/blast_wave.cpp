#include "loads/blast/blast_wave.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace courant {

namespace {

/// log10 of a quantity as a polynomial in u = a + b log10 Z, up to a distance.
struct Fit {
  Real up_to;  ///< Z [ft/lb^(1/3)]
  Real a, b;
  std::vector<Real> c;
  Real operator()(Real log_z) const {
    const Real u = a + b * log_z;
    Real sum = 0;
    for (std::size_t k = c.size(); k-- > 0;) sum = sum * u + c[k];
    return std::pow(10, sum);
  }
};
constexpr Real end_of_range = 100;

/// Pieces by distance.
struct Quantity {
  std::vector<Fit> pieces;
  Real at(Real z) const {
    std::size_t k = 0;
    while (k + 1 < pieces.size() && z > pieces[k].up_to) ++k;
    return pieces[k](std::log10(z));
  }
};
struct Fits {
  Quantity arrival, duration;                    ///< [ms/lb^(1/3)]
  Quantity incident, reflected;                  ///< [psi]
  Quantity incident_impulse, reflected_impulse;  ///< [psi ms/lb^(1/3)]
};

const Fits& surface_fits() {
  static const Fits fits{
      .arrival = {{{end_of_range,
                    -0.755684472698,
                    1.37784223635,
                    {-0.173607601251, 1.35706496258, 0.052492798645, -0.196563954086, -0.0601770052288,
                     0.0696360270891, 0.0215297490092, -0.0161658930785, -0.00232531970294,
                     0.00147752067524}}}},
      .duration = {{{2.54,
                     -0.1790217052,
                     5.25099193925,
                     {-0.728671776005, 0.130143717675, 0.134872511954, 0.0391574276906, -0.00475933664702,
                      -0.00428144598008}},
                    {7,
                     -5.85909812338,
                     9.2996288611,
                     {0.20096507334, -0.0297944268976, 0.030632954288, 0.0183405574086, -0.0173964666211,
                      -0.00106321963633, 0.00562060030977, 0.0001618217499, -0.0006860188944}},
                    {end_of_range,
                     -4.92699491141,
                     3.46349745571,
                     {0.572462469964, 0.0933035304009, -0.0005849420883, -0.00226884995013, -0.00295908591505,
                      0.00148029868929}}}},
      .incident = {{{end_of_range,
                     -0.756579301809,
                     1.35034249993,
                     {1.9422502013, -1.6958988741, -0.154159376846, 0.514060730593, 0.0988534365274,
                      -0.293912623038, -0.0268112345019, 0.109097496421, 0.00162846756311, -0.0214631030242,
                      0.0001456723382, 0.00167847752266}}}},
      .reflected = {{{end_of_range,
                      -0.789312405513,
                      1.36637719229,
                      {2.56431321138, -2.21030870597, -0.218536586295, 0.895319589372, 0.24989009775,
                       -0.569249436807, -0.11791682383, 0.224131161411, 0.0245620259375, -0.0455116002694,
                       -0.00190930738887, 0.00361471193389}}}},
      .incident_impulse = {{{2.41,
                             0.832468843425,
                             3.0760329666,
                             {1.57159240621, -0.502992763686, 0.171335645235, 0.0450176963051,
                              -0.0118964626402}},
                            {end_of_range,
                             -2.91358616806,
                             2.40697745406,
                             {0.719852655584, -0.384519026965, -0.0260816706301, 0.00595798753822,
                              0.014544526107, -0.00663289334734, -0.00284189327204, 0.0013644816227}}}},
      .reflected_impulse = {{{end_of_range,
                              -0.781951689212,
                              1.33422049854,
                              {1.75291677799, -0.949516092853, 0.112136118689, -0.0250659183287}}}}};
  return fits;
}

const Fits& air_fits() {
  static const Fits fits{
      .arrival = {{{end_of_range,
                    -0.80501734056,
                    1.37407043777,
                    {-0.0423733936826, 1.36456871214, -0.0570035692784, -0.182832224796, 0.0118851436014,
                     0.0432648687627, -0.0007997367834, -0.00436073555033}}}},
      .duration = {{{2.24,
                     0.209440059933,
                     5.11588554305,
                     {-0.801052722864, 0.164953518069, 0.127788499497, 0.00291430135946, 0.00187957449227,
                      0.0173413962543, 0.00269739758043, -0.00361976502798, -0.00100926577934}},
                    {5.75,
                     -5.06778493835,
                     9.2996288611,
                     {0.115874238335, -0.0297944268969, 0.0306329542941, 0.018340557407, -0.0173964666286,
                      -0.00106321963576, 0.0056206003128, 0.0001618217499, -0.0006860188944}},
                    {end_of_range,
                     -4.39590184126,
                     3.1524725364,
                     {0.50659210403, 0.0967031995552, -0.00801302059667, 0.00482705779732, 0.00187587272287,
                      -0.00246738509321, -0.000841116668, 0.0006193291052}}}},
      .incident = {{{end_of_range,
                     -0.756579301809,
                     1.35034249993,
                     {1.77284970457, -1.69012801396, 0.00804973591951, 0.336743114941, -0.00516226351334,
                      -0.0809228619888, -0.00478507266747, 0.00793030472242, 0.0007684469735}}}},
      .reflected = {{{end_of_range,
                      -0.756579301809,
                      1.35034249993,
                      {2.39106134946, -2.21400538997, 0.035119031446, 0.657599992109, 0.0141818951887,
                       -0.243076636231, -0.0158699803158, 0.0492741184234, 0.00227639644004,
                       -0.00397126276058}}}},
      .incident_impulse =
          {{{2,
             1.04504877747,
             3.24299066475,
             {1.43534136453, -0.443749377691, 0.168825414684, 0.0348138030308, -0.010435192824}},
            {end_of_range,
             -2.67912519532,
             2.30629231803,
             {0.599008468099, -0.40463292088, -0.0142721946082, 0.00912366316617, -0.0006750681404,
              -0.00800863718901, 0.00314819515931, 0.00152044783382, -0.0007470265899}}}},
      .reflected_impulse = {{{end_of_range,
                              -0.757659920369,
                              1.37882996018,
                              {1.60579280091, -0.903118886091, 0.101771877942, -0.0242139751146}}}}};
  return fits;
}

/// Of a wave (1 - tau) exp(-b tau) what it gives up to tau = 1.
Real positive_share(Real b) {
  constexpr Real small = 1e-4;
  return std::abs(b) < small ? 0.5 - b / 6 : (b - 1 + std::exp(-b)) / (b * b);
}
/// Of its suction (1 - tau) exp(-b - a (tau - 1)), tau > 1: a is b, but so large that the suction takes back
/// no more than the wave gave, as it does below b = 1. Far from charges b falls to 0, where it would take
/// all.
Real suction_decay(Real b) {
  return std::max(b, std::sqrt(std::exp(-b) / positive_share(b)));
}

/// b of the impulse P T positive_share(b), which falls with b from P T/2 at 0.
Real decay_of(Real peak, Real duration, Real impulse) {
  const Real share = impulse / (peak * duration);
  Real low = -50, high = 1e4;
  constexpr int halvings = 100;
  for (int k = 0; k < halvings; ++k) {
    const Real middle = 0.5 * (low + high);
    (positive_share(middle) > share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

BlastRange blast_range(BlastKind kind) {
  return {kind == BlastKind::surface ? 0.45 : 0.37, end_of_range};  // where all fits hold
}

BlastWave blast_wave(BlastKind kind, Real mass, Real distance) {
  const Fits& fits = kind == BlastKind::surface ? surface_fits() : air_fits();
  const Real scale = std::cbrt(mass), z = distance / scale;
  BlastWave out;
  out.arrival = scale * fits.arrival.at(z), out.duration = scale * fits.duration.at(z);
  out.incident = fits.incident.at(z), out.reflected = fits.reflected.at(z);
  out.incident_impulse = scale * fits.incident_impulse.at(z);
  out.reflected_impulse = scale * fits.reflected_impulse.at(z);
  out.incident_decay = decay_of(out.incident, out.duration, out.incident_impulse);
  out.reflected_decay = decay_of(out.reflected, out.duration, out.reflected_impulse);
  return out;
}

Real BlastWave::impulse(Real t, Real c, bool positive_only) const {
  Real tau = (t - arrival) / duration;
  if (positive_only) tau = std::min(tau, Real(1));
  if (tau <= 0) return 0;
  const auto of = [tau](Real b) {
    if (tau > 1) {
      const Real a = suction_decay(b), x = a * (tau - 1);
      return positive_share(b) - std::exp(-b) * (1 - (1 + x) * std::exp(-x)) / (a * a);
    }
    constexpr Real small = 1e-4;
    if (std::abs(b) < small) return tau - 0.5 * tau * tau;
    const Real gone = -std::expm1(-b * tau);
    return gone / b - (gone - b * tau * std::exp(-b * tau)) / (b * b);
  };
  const Real passing = incident * of(incident_decay), thrown_back = reflected * of(reflected_decay);
  return duration * (c > 0 ? thrown_back * c * c + passing * (1 + c - 2 * c * c) : passing);
}

Real BlastWave::pressure(Real t, Real c, bool positive_only) const {
  const Real tau = (t - arrival) / duration;
  if (tau < 0 || (positive_only && tau > 1)) return 0;
  const auto of = [tau](Real b) {
    return tau > 1 ? std::exp(-b - suction_decay(b) * (tau - 1)) : std::exp(-b * tau);
  };
  const Real passing = incident * of(incident_decay), thrown_back = reflected * of(reflected_decay);
  const Real on_face = c > 0 ? thrown_back * c * c + passing * (1 + c - 2 * c * c) : passing;
  return on_face * (1 - tau);
}

}  // namespace courant
