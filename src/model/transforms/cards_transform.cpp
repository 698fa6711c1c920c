// Tables of transformations.
#include "keyword/read/number.hpp"
#include "keyword/registry.hpp"
#include "keyword/source.hpp"
#include "model/transforms/transform_cards.hpp"
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

const RegisterKeyword<T> define_transformation{define_transformation_table()};
const RegisterKeyword<NodeTransformCard> node_transform{node_transform_table()};
const RegisterKeyword<PartMoveCard> part_move{part_move_table()};

}  // namespace

std::string convert_transformation(DefineTransformationCardFields& fields, const Conversion& conversion) {
  auto& card = static_cast<DefineTransformationCard&>(fields);
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

}  // namespace courant
