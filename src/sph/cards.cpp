#include "sph/cards.hpp"

#include "keyword/registry.hpp"

namespace courant {

namespace {

const RegisterKeyword<SectionSph> section_sph{{
    .names = {"SECTION_SPH"},
    .purpose = "smoothing length of SPH parts",
    .id_space = "section",
    .title_option = true,
    .title = &SectionSph::title,
    .cards = {{.fields = {
        {"SECID", &SectionSph::secid, "-", "section id", {.required = true, .check = Check::positive}},
        {"CSLH", &SectionSph::cslh, "-", "h0 = CSLH x largest nearest-neighbour distance of the part",
         {.standard = 1.2, .check = Check::positive}},
        {"HMIN", &SectionSph::hmin, "-", "lower bound of h/h0", {.standard = 0.2, .check = Check::positive}},
        {"HMAX", &SectionSph::hmax, "-", "upper bound of h/h0", {.standard = 2.0, .check = Check::positive}},
        {"SPHINI", &SectionSph::sphini, "L", "given h0, instead of CSLH", {.check = Check::not_negative}},
        {"DEATH", &SectionSph::death, "T", "time the SPH approximation stops", {.standard = 1e20, .honour = Honour::no}},
        {"START", &SectionSph::start, "T", "time the SPH approximation starts", {.honour = Honour::no}},
        {"SPHKERN", &SectionSph::sphkern, "-", "kernel: 0 cubic spline", {.allowed = {0}}}}}}}};

const RegisterKeyword<ControlSph> control_sph{{
    .names = {"CONTROL_SPH"},
    .purpose = "SPH: dimension, formulation, computational box, viscosity form",
    .once = true,
    .many = false,
    .cards = {
        {.fields =
             {{"NCBS", &ControlSph::ncbs, "-", "cycles between sorts; lists are kept by a skin instead",
               {.standard = 1, .honour = Honour::ignored}},
              {"BOXID", &ControlSph::boxid, "-", "box outside of which particles keep state and velocity",
               {.check = Check::not_negative}},
              {"DT", &ControlSph::dt, "T", "death time of SPH", {.standard = 1e20, .honour = Honour::no}},
              {"IDIM", &ControlSph::idim, "-", "2 plane strain in x-y, 3 three-dimensional, 0 from the geometry",
               {.allowed = {0, 2, 3}}},
              {"NMNEIGH", &ControlSph::nmneigh, "-", "neighbour memory", {.standard = 150, .honour = Honour::ignored}},
              {"FORM", &ControlSph::form, "-", "formulation: 0 default", {.allowed = {0}}},
              {"START", &ControlSph::start, "T", "start time of SPH", {.honour = Honour::no}},
              {"MAXV", &ControlSph::maxv, "L/T", "speed limit: > 0 faster particles are switched off, < 0 clipped",
               {.standard = 1e15}}}},
        {.fields =
             {{"CONT", &ControlSph::cont, "-", "0 all SPH parts interact", {.allowed = {0}}},
              {"DERIV", &ControlSph::deriv, "-", "dh/dt: 0 h div v / dim", {.allowed = {0}}},
              {"INI", &ControlSph::ini, "-", "initial h: 0 from nearest neighbours", {.allowed = {0}}},
              {"ISHOW", &ControlSph::ishow, "-", "1 hides particles outside the box in the field files", {.allowed = {0, 1}}},
              {"IEROD", &ControlSph::ierod, "-", "eroded particles", {.honour = Honour::no}},
              {"ICONT", &ControlSph::icont, "-", "1 no contact for particles outside the box", {.allowed = {0, 1}}},
              {"IAVIS", &ControlSph::iavis, "-", "artificial viscosity: 0 Monaghan, 1 bulk", {.allowed = {0, 1}}},
              {"ISYMP", &ControlSph::isymp, "-", "ghost memory", {.standard = 100, .honour = Honour::ignored}}},
         .optional = true},
        {.fields =
             {{"ITHK", &ControlSph::ithk, "-", "1 contact thickness of particles from their volume", {.allowed = {0, 1}}},
              {"ISTAB", &ControlSph::istab, "-", "for FORM 12", {.honour = Honour::ignored}},
              {"QL", &ControlSph::ql, "-", "for FORM 12", {.standard = 0.01, .honour = Honour::ignored}},
              {"", std::monostate{}, "-", "unused", {}},
              {"SPHSORT", &ControlSph::sphsort, "-", "implicit sorting", {.honour = Honour::ignored}},
              {"ISHIFT", &ControlSph::ishift, "-", "particle shifting", {.honour = Honour::no}}},
         .optional = true}}}};

const RegisterKeyword<Hourglass> hourglass{{
    .names = {"HOURGLASS"},
    .purpose = "bulk viscosity coefficients of the parts that name it (HGID)",
    .id_space = "hourglass",
    .title_option = true,
    .title = &Hourglass::title,
    .cards = {{.fields = {
        {"HGID", &Hourglass::hgid, "-", "id that *PART refers to", {.required = true, .check = Check::positive}},
        {"IHQ", &Hourglass::ihq, "-", "hourglass type; particles have none", {.honour = Honour::ignored}},
        {"QM", &Hourglass::qm, "-", "hourglass coefficient", {.standard = 0.1, .honour = Honour::ignored}},
        {"IBQ", &Hourglass::ibq, "-", "not used", {.honour = Honour::ignored}},
        {"Q1", &Hourglass::q1, "-", "quadratic viscosity (beta); 0 is the default, write 1.0E-20 for none",
         {.standard = 1.5, .check = Check::not_negative}},
        {"Q2", &Hourglass::q2, "-", "linear viscosity (alpha); 0 is the default, write 1.0E-20 for none",
         {.standard = 0.06, .check = Check::not_negative}},
        {"QB/VDC", &Hourglass::qb, "-", "shell bending coefficient", {.standard = 0.1, .honour = Honour::ignored}},
        {"QW", &Hourglass::qw, "-", "shell warping coefficient", {.standard = 0.1, .honour = Honour::ignored}}}}}}};

const RegisterKeyword<ControlBulkViscosity> bulk_viscosity{{
    .names = {"CONTROL_BULK_VISCOSITY"},
    .purpose = "artificial viscosity coefficients of parts without an *HOURGLASS",
    .once = true,
    .many = false,
    .cards = {{.fields = {
        {"Q1", &ControlBulkViscosity::q1, "-", "quadratic viscosity (beta); 0 is the default, write 1.0E-20 for none",
         {.standard = 1.5, .check = Check::not_negative}},
        {"Q2", &ControlBulkViscosity::q2, "-", "linear viscosity (alpha); 0 is the default, write 1.0E-20 for none",
         {.standard = 0.06, .check = Check::not_negative}},
        {"TYPE", &ControlBulkViscosity::type, "-", "1 standard (-1, -2: also in shells, which are rigid here)",
         {.standard = 1, .allowed = {-2, -1, 1}}},
        {"BTYPE", &ControlBulkViscosity::btype, "-", "beams", {.honour = Honour::ignored}},
        {"TSTYPE", &ControlBulkViscosity::tstype, "-", "thick shells", {.honour = Honour::ignored}}}}}}};

}  // namespace

}  // namespace courant
