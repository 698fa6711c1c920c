#include "model/transforms/transformation.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <unordered_map>

#include "keyword/read/number.hpp"
#include "keyword/source.hpp"
#include "model/cards.hpp"

namespace courant {

namespace {

using Card = DefineTransformationCard;
using Frame = std::array<Vec, 3>;  // three points

constexpr Real tolerance = 1e-6;  // decks give direction cosines and matrices with few digits

/// Rotation and translation that bring the first point of `from` to that of `to`, the line to the second onto
/// that line, and the plane of all three onto that plane.
std::optional<Affine> placing(const Frame& from, const Frame& to) {
  const auto axes = [](const Frame& p, Matrix& out) {
    const Vec e1 = p[1] - p[0], e3 = e1.cross(p[2] - p[0]);
    if (!(e3.norm() > 1e-10 * e1.norm() * (p[2] - p[0]).norm())) return false;
    out.col(0) = e1.stableNormalized();
    out.col(2) = e3.stableNormalized();
    out.col(1) = out.col(2).cross(out.col(0));
    return true;
  };
  Matrix a, b;
  if (!axes(from, a) || !axes(to, b)) return std::nullopt;
  Affine out = Affine::Identity();
  out.linear() = b * a.transpose();
  out.translation() = to[0] - out.linear() * from[0];
  return out;
}

Affine about(const Vec& point, const Matrix& linear) {
  Affine out = Affine::Identity();
  out.linear() = linear;
  out.translation() = point - linear * point;
  return out;
}

/// The operations of one card, in their order.
class Evaluation {
 public:
  using NodeOfId = std::function<std::optional<Vec>(const Card&, std::size_t row, Id)>;
  Evaluation(const Deck& deck, const Card& card, const NodeOfId& node, Diagnostics& diagnostics)
      : deck_(deck), card_(card), node_(node), diagnostics_(diagnostics) {}

  Affine result() {
    for (row_ = 0; row_ < card_.rows(); ++row_) {
      const Affine next = operation(upper_case(card_.option[row_]));
      motion_ = next * motion_;
      any_before_ = any_before_ || next.matrix() != Affine::Identity().matrix();
      if (faulty_) return Affine::Identity();  // one fault may cause others
    }
    row_ = 0;
    if (!motion_.matrix().allFinite())
      return error("OPTION", "the numbers of the operations are too large to compute with");
    if (motion_.linear().determinant() == 0) {
      error("OPTION", "the operations press space flat",
            "a scale or a matrix leaves nothing of one direction");
    }
    return motion_;
  }

 private:
  Affine operation(const std::string& name) {
    if (name == "TRANSL") return Affine(Eigen::Translation3d(vec(1)));
    if (name == "SCALE") return scale();
    if (name == "MIRROR") return mirror();
    if (name == "ROTATE") return rotate();
    if (name == "ROTATE3NA") return rotate_by_nodes();
    if (name == "TRANSL2ND") return translate_by_nodes();
    if (name == "POINT") return point();
    if (name == "POS6P" || name == "POS6N") return place(name == "POS6N");
    if (name == "MATRIX") return matrix();
    bool blank = name.empty();
    for (std::size_t k = 1; k <= 7; ++k) blank = blank && a(k) == 0;
    if (blank) return Affine::Identity();
    return error(
        "OPTION", fmt::format("'{}' is no operation", card_.option[row_]),
        "known are TRANSL, ROTATE, SCALE, MIRROR, POINT, POS6P, POS6N, ROTATE3NA, TRANSL2ND and MATRIX");
  }

  Affine scale() {
    const auto factor = [&](std::size_t k) { return a(k) == 0 ? 1 : a(k); };
    return Affine(Eigen::Scaling(factor(1), factor(2), factor(3)));
  }

  Affine mirror() {
    const Vec normal = vec(4) - vec(1);
    if (normal.stableNorm() == 0)
      return error("A4", "the two points of the mirror are one",
                   "its plane lies across the line from A1-A3 to A4-A6");
    if (a(7) != 0)
      return error("A7", fmt::format("'{:g}' (coordinate systems become left-handed) is not supported", a(7)),
                   "leave the field blank or 0");
    const Vec n = normal.stableNormalized();
    return about(vec(1), Matrix::Identity() - 2 * n * n.transpose());
  }

  Affine rotate() {
    // by two POINTs, unless it is an axis without an angle: a turn by 0
    const auto is_number = [](Real v) { return v > 0 && v == std::floor(v); };
    const bool one = (is_number(a(1)) && a(2) == 0) || (is_number(a(2)) && a(1) == 0);
    const bool points = (is_number(a(1)) && is_number(a(2))) || (one && a(3) != 0);
    if (points && a(4) == 0 && a(5) == 0 && a(6) == 0 && a(7) == 0) {
      const auto from = named_point("A1", a(1)), to = named_point("A2", a(2));
      return from && to ? turn("A1", *from, *to - *from, a(3)) : Affine::Identity();
    }
    return turn("A1", vec(4), vec(1), a(7));
  }

  Affine rotate_by_nodes() {
    const auto from = node("A1", a(1)), to = node("A2", a(2)), through = node("A3", a(3));
    return from && to && through ? turn("A1", *through, *to - *from, a(4)) : Affine::Identity();
  }

  Affine turn(const char* field, const Vec& centre, const Vec& axis, Real degrees) {
    if (axis.stableNorm() == 0) return error(field, "the axis of the rotation has no direction");
    return about(centre, rotation(axis, degrees));
  }

  Affine translate_by_nodes() {
    const auto from = node("A1", a(1)), to = node("A2", a(2));
    if (!from || !to) return Affine::Identity();
    if (*from == *to) return error("A1", "the two nodes are at one position, which is no direction");
    return Affine(Eigen::Translation3d(a(3) * (*to - *from).stableNormalized()));
  }

  Affine point() {
    if (!(a(1) > 0) || a(1) != std::floor(a(1)))
      return error("A1", fmt::format("expected the number of a point, an integer > 0, got '{:g}'", a(1)));
    // it takes part in all operations, also in those above its line
    points_[a(1)] = vec(2);
    return Affine::Identity();
  }

  Affine place(bool by_nodes) {
    if (any_before_)
      return error("OPTION", fmt::format("{} behind other operations is not supported", card_.option[row_]),
                   "it is not known whether the targets move, too: list it first");
    std::array<Vec, 6> p;
    for (std::size_t k = 0; k < 6; ++k) {
      const std::string field = fmt::format("A{}", k + 1);
      const auto found = by_nodes ? node(field, a(k + 1)) : named_point(field, a(k + 1));
      if (!found) return Affine::Identity();
      p[k] = *found;
    }
    const auto out = placing({p[0], p[1], p[2]}, {p[3], p[4], p[5]});
    return out ? *out : error("A1", "three of the six are on one line");
  }

  /// M11 to M44 on two lines below; a point as a row with a 1 behind it is multiplied by the matrix.
  Affine matrix() {
    const std::size_t first = row_ + 1;
    if (card_.rows() < first + 2) return error("OPTION", "the two lines of the matrix are missing");
    Eigen::Matrix<Real, 4, 4, Eigen::RowMajor> m;
    for (std::size_t line = 0; line < 2; ++line) {
      row_ = first + line;
      Real begin = 0;
      if (!trimmed(card_.option[row_]).empty() && !parse_real(card_.option[row_], begin))
        return error("OPTION", fmt::format("expected a number of the matrix, got '{}'", card_.option[row_]));
      m.data()[8 * line] = begin;
      for (std::size_t k = 1; k <= 7; ++k) m.data()[8 * line + k] = a(k);
    }
    if (m.col(3) != Eigen::Vector4d(0, 0, 0, 1))
      return error("A3", "the last column of the matrix is not 0, 0, 0, 1",
                   "it would make distances depend on position");
    Affine out = Affine::Identity();
    out.linear() = m.topLeftCorner<3, 3>().transpose();
    out.translation() = m.bottomLeftCorner<1, 3>().transpose();
    return out;
  }

  Real a(std::size_t k) const { return card_.a(k, row_); }
  Vec vec(std::size_t k) const { return {a(k), a(k + 1), a(k + 2)}; }

  std::optional<Vec> named_point(const std::string& field, Real number) {
    const auto it = points_.find(number);
    if (it != points_.end()) return motion_ * it->second;
    error(field, fmt::format("POINT {:g} is not above this line", number));
    return std::nullopt;
  }

  std::optional<Vec> node(const std::string& field, Real number) {
    constexpr Real largest = 1e15;
    if (!(number > 0) || number != std::floor(number) || number > largest) {
      error(field, fmt::format("expected a node id, got '{:g}'", number));
      return std::nullopt;
    }
    const auto found = node_(card_, row_, static_cast<Id>(number));
    faulty_ = faulty_ || !found;
    return found;
  }

  Affine error(const std::string& field, const std::string& message, std::string hint = {}) {
    faulty_ = true;
    diagnostics_.error(deck_.where(card_, field, Deck::Repeat{.row = row_}),
                       deck_.describe(card_, field) + ": " + message, std::move(hint));
    return Affine::Identity();
  }

  const Deck& deck_;
  const Card& card_;
  const NodeOfId& node_;
  Diagnostics& diagnostics_;
  std::size_t row_ = 0;
  Affine motion_ = Affine::Identity();  // of the rows so far
  std::map<Real, Vec> points_;
  bool any_before_ = false, faulty_ = false;
};

/// Finds nodes for transformations. Those of files that are moved otherwise than the transformation's own
/// file have no position yet.
Evaluation::NodeOfId node_finder(const Deck& deck, Diagnostics& diagnostics) {
  std::unordered_map<Id, const NodeCard*> nodes;
  const auto& cards = deck.all<Card>();
  const bool wanted = std::any_of(cards.begin(), cards.end(), [](const Card& c) { return c.names_nodes(); });
  if (wanted)
    for (const NodeCard& n : deck.all<NodeCard>()) nodes.emplace(n.nid, &n);
  const auto moved_by = [&deck](const Entry& e) -> const std::vector<Id>& {
    return deck.files[static_cast<std::size_t>(e.file)].conversion.transformations;
  };
  return
      [&deck, &diagnostics, nodes, moved_by](const Card& card, std::size_t row, Id id) -> std::optional<Vec> {
        const auto it = nodes.find(id);
        const auto fail = [&](std::string message, std::string hint) {
          diagnostics.error(deck.where(card, "OPTION", Deck::Repeat{.row = row}),
                            deck.describe(card, "OPTION") + ": " + std::move(message), std::move(hint));
          return std::nullopt;
        };
        if (it == nodes.end())
          return fail(fmt::format("node {} has no coordinates", id), "define it with *NODE");
        if (moved_by(*it->second) != moved_by(card))
          return fail(fmt::format("node {} is in a file that is moved otherwise than this one", id),
                      "name nodes of the file of the transformation");
        return Vec(it->second->x, it->second->y, it->second->z);
      };
}

}  // namespace

std::size_t DefineTransformationCard::rows() const {
  return std::min(
      {option.size(), a1.size(), a2.size(), a3.size(), a4.size(), a5.size(), a6.size(), a7.size()});
}

bool DefineTransformationCard::names_nodes() const {
  return std::any_of(option.begin(), option.end(), [](const std::string& text) {
    const std::string operation = upper_case(text);
    return operation == "ROTATE3NA" || operation == "TRANSL2ND" || operation == "POS6N";
  });
}

Real DefineTransformationCard::a(std::size_t k, std::size_t row) const {
  const std::vector<Real>* columns[] = {&a1, &a2, &a3, &a4, &a5, &a6, &a7};
  return (*columns[k - 1])[row];
}

void evaluate_transformations(Deck& deck, Diagnostics& diagnostics) {
  const auto node = node_finder(deck, diagnostics);
  for (Card& card : deck.store<Card>()) card.motion = Evaluation(deck, card, node, diagnostics).result();
}

const Affine* find_transformation(const Deck& deck, Id tranid) {
  for (const Card& card : deck.all<Card>())
    if (card.tranid == tranid) return &card.motion;
  return nullptr;
}

Affine motion_of_file(const Deck& deck, const DeckFile& file) {
  Affine out = Affine::Identity();
  for (const Id id : file.conversion.transformations)
    if (const Affine* next = find_transformation(deck, id)) out = *next * out;
  return out;
}

Matrix rotation(const Vec& axis, Real degrees) {
  const Real turns = degrees / 90, whole = std::round(turns);
  Real c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  if (turns == whole) {  // sin(pi) is not 0 in floating point
    c = std::round(c);
    s = std::round(s);
  }
  const Vec n = axis.stableNormalized();
  Matrix across;
  across << 0, -n[2], n[1], n[2], 0, -n[0], -n[1], n[0], 0;
  return c * Matrix::Identity() + s * across + (1 - c) * n * n.transpose();
}

bool keeps_lengths(const Affine& motion) {
  const Matrix m = motion.linear();
  return (m.transpose() * m - Matrix::Identity()).cwiseAbs().maxCoeff() < tolerance;
}

bool maps_axes(const Affine& motion) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Vec image = motion.linear().col(k).stableNormalized().cwiseAbs();
    Eigen::Index largest = 0;
    image.maxCoeff(&largest);
    if ((image - Vec::Unit(largest)).norm() > tolerance) return false;
  }
  return true;
}

std::array<bool, 3> axes_of_code(int code) {
  return {code == 1 || code == 4 || code == 6 || code == 7, code == 2 || code == 4 || code == 5 || code == 7,
          code == 3 || code == 5 || code == 6 || code == 7};
}

int code_of_axes(const std::array<bool, 3>& held) {
  for (int code = 0; code < 7; ++code)
    if (axes_of_code(code) == held) return code;
  return 7;
}

std::string move_held_axes(std::array<bool, 3>& held, const Affine& motion) {
  if (held[0] == held[1] && held[1] == held[2]) return {};
  Matrix turn = motion.linear();
  for (Eigen::Index k = 0; k < 3; ++k) turn.col(k).stableNormalize();
  Matrix space = Matrix::Zero();  // projects a displacement onto what is held
  for (Eigen::Index k = 0; k < 3; ++k) space(k, k) = held[static_cast<std::size_t>(k)];
  const Matrix moved = turn * space * turn.transpose();
  std::array<bool, 3> now{};
  Matrix along_axes = Matrix::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    now[static_cast<std::size_t>(k)] = moved(k, k) > 0.5;
    along_axes(k, k) = moved(k, k) > 0.5;
  }
  if ((moved - along_axes).cwiseAbs().maxCoeff() > tolerance)
    return "the file is moved so that directions held along axes no longer lie along axes";
  held = now;
  return {};
}

std::string refuse_stretch(const Affine& motion, std::string_view what) {
  if (keeps_lengths(motion)) return {};
  return "the file is scaled by a transformation, which leaves open whether " + std::string(what) +
         " are, too";
}

std::string move_velocity(Real& x, Real& y, Real& z, const Affine& motion) {
  const Vec v(x, y, z);
  if (v == Vec::Zero() || motion.linear() == Matrix::Identity()) return {};
  if (std::string reason = refuse_stretch(motion, "velocities"); !reason.empty()) return reason;
  const Vec now = motion.linear() * v;
  x = now[0], y = now[1], z = now[2];
  return {};
}

}  // namespace courant
