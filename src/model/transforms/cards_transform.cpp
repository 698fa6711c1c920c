// Tables of transformations.
#include "keyword/number.hpp"
#include "keyword/registry.hpp"
#include "keyword/source.hpp"
#include "model/transforms/transformation.hpp"

namespace courant {

namespace {

using T = DefineTransformationCard;

/// Which of A1 to A7 are lengths, and which are node ids, from one to another; 0: none.
struct ColumnKinds {
  const char* option;
  std::size_t length_from, length_to, node_from, node_to;
};
constexpr ColumnKinds kinds[] = {
    {"TRANSL", 1, 3, 0, 0},    {"MIRROR", 1, 6, 0, 0},    {"ROTATE", 4, 6, 0, 0}, {"POINT", 2, 4, 0, 0},
    {"TRANSL2ND", 3, 3, 1, 2}, {"ROTATE3NA", 0, 0, 1, 3}, {"POS6N", 0, 0, 1, 6},
};

std::string convert_transformation(T& card, const Conversion& conversion) {
  std::vector<Real>* columns[] = {&card.a1, &card.a2, &card.a3, &card.a4, &card.a5, &card.a6, &card.a7};
  for (std::size_t row = 0; row < card.rows(); ++row) {
    const std::string option = upper_case(card.option[row]);
    if (option == "MATRIX" && row + 2 < card.rows()) {
      row += 2;  // M31 to M44; the last three but one are the translation
      for (std::size_t k = 4; k <= 6; ++k) (*columns[k - 1])[row] *= conversion.units.length;
    }
    for (const ColumnKinds& kind : kinds) {
      if (option != kind.option) continue;
      for (std::size_t k = 1; k <= 7; ++k) {
        Real& value = (*columns[k - 1])[row];
        if (k >= kind.length_from && k <= kind.length_to) value *= conversion.units.length;
        if (k >= kind.node_from && k <= kind.node_to)
          value += static_cast<Real>(value > 0 ? conversion.offsets.node : 0);
      }
    }
  }
  return {};
}

const RegisterKeyword<T> define_transformation{
    {.names = {"DEFINE_TRANSFORMATION", "DEFINE_TRANSFORM"},
     .purpose = "operations that move points, one after the other: TRANSL, ROTATE, SCALE, MIRROR, POS6P, "
                "POS6N, ROTATE3NA, TRANSL2ND, MATRIX; POINT names a place for them",
     .id_space = IdSpace::transformation,
     .title_option = true,
     .title = &T::title,
     .cards = {{.fields = {{"TRANID",
                            &T::tranid,
                            "-",
                            "transformation id",
                            {.required = true, .check = Check::positive}}}},
               {.fields = {{"OPTION", &T::option, "-", "operation, or M11 and M31 below MATRIX"},
                           {"A1", &T::a1, "-", "first number of the operation"},
                           {"A2", &T::a2, "-", "second number"},
                           {"A3", &T::a3, "-", "third number"},
                           {"A4", &T::a4, "-", "fourth number"},
                           {"A5", &T::a5, "-", "fifth number"},
                           {"A6", &T::a6, "-", "sixth number"},
                           {"A7", &T::a7, "-", "seventh number"}},
                .repeat = true}},
     .convert = convert_transformation}};

using N = NodeTransformCard;
const RegisterKeyword<N> node_transform{
    {.names = {"NODE_TRANSFORM"},
     .purpose =
         "moves the nodes of a set, once the deck and the files of INCLUDE_TRANSFORM are read and moved",
     .cards = {{.fields = {{"TRSID",
                            &N::trsid,
                            "-",
                            "transformation id",
                            {.required = true, .check = Check::positive, .refers = IdSpace::transformation}},
                           {"NSID",
                            &N::nsid,
                            "-",
                            "node set id",
                            {.required = true, .check = Check::positive, .refers = IdSpace::node_set}},
                           {"IMMED",
                            &N::immed,
                            "-",
                            "1 at once; the same here, if no transformation names nodes",
                            {.allowed = {0, 1}}}}}}}};

}  // namespace

}  // namespace courant
