// Control words and geometry, as public descriptions of the LS-DYNA database and its open readers have them.
#include <algorithm>
#include <array>
#include <set>

#include "d3plot/d3plot_model.hpp"
#include "d3plot/family.hpp"

namespace courant {
namespace {

constexpr int words_of_particle[] = {1, 1, 6, 1, 1, 1, 1, 6, 1};  // behind the part, see put_particles

int parts_of(const D3plotMesh& mesh, ElementKind kind) {
  return static_cast<int>(std::count_if(mesh.parts.begin(), mesh.parts.end(), [&](const D3plotPart& part) {
    return !part.sph && part.kind == kind;
  }));
}

/// The 64 words in front.
class Control {
 public:
  explicit Control(const std::string& title, int bits) : words_(bits) {
    words_.text(title, 10 * words_.width());
  }
  void set(std::size_t word, std::int64_t value) { values_[word - 10] = value; }
  Words finish() {
    for (std::size_t k = 0; k < values_.size(); ++k)
      if (k == 3)
        words_.text("R16", words_.width());
      else if (k == 4)
        words_.real(971);  // before 971 rigid walls have one word each
      else
        words_.integer(values_[k]);
    return std::move(words_);
  }

 private:
  Words words_;
  std::array<std::int64_t, 54> values_{};
};

Words control_words(const D3plotMesh& mesh, const D3plotExtent& x, std::size_t globals, bool deletion) {
  const auto flag = [](bool on) { return on ? 1000 : 0; };
  Control c(mesh.title, x.bits);
  c.set(11, 1);  // d3plot
  c.set(12, 16);
  c.set(15, 4);  // three dimensions, whole connectivity, no list of rigid materials
  c.set(16, static_cast<std::int64_t>(mesh.node_ids.size()));
  c.set(17, 6);
  c.set(18, static_cast<std::int64_t>(globals));
  for (const std::size_t word : {20, 21, 22}) c.set(word, 1);  // places, velocities, accelerations
  c.set(23, static_cast<std::int64_t>(mesh.solids.size()));
  c.set(24, parts_of(mesh, ElementKind::solid));
  c.set(27, x.words_of_solid());
  c.set(28, static_cast<std::int64_t>(mesh.beams.size()));
  c.set(29, parts_of(mesh, ElementKind::beam));
  c.set(30, x.words_of_beam());
  c.set(31, static_cast<std::int64_t>(mesh.shells.size()));
  c.set(32, parts_of(mesh, ElementKind::shell));
  c.set(33, x.words_of_shell());
  c.set(34, x.numbers_of_solids());
  c.set(35, x.history_of_shells);
  c.set(36, deletion ? -(10000 + x.points_of_shells) : x.points_of_shells);
  const auto of_sph =
      std::count_if(mesh.parts.begin(), mesh.parts.end(), [](const auto& p) { return p.sph; });
  c.set(37, static_cast<std::int64_t>(mesh.particles.size()));
  c.set(38, of_sph);
  c.set(39, static_cast<std::int64_t>(16 + mesh.node_ids.size() + mesh.solids.size() + mesh.beams.size() +
                                      mesh.shells.size() + 3 * mesh.parts.size()));
  c.set(43, x.stress ? 1000 : 999), c.set(44, x.plastic ? 1000 : 999);  // 999: of solids alone
  c.set(45, flag(x.resultants)), c.set(46, flag(x.extra));
  c.set(51, static_cast<std::int64_t>(mesh.parts.size()));
  return c.finish();
}

void add_elements(const std::vector<D3plotElement>& elements, std::size_t nodes, std::size_t zeros,
                  Words& out) {
  for (const D3plotElement& one : elements) {
    for (std::size_t c = 0; c < nodes; ++c) out.integer(one.node[c] + 1);
    out.zeros(zeros);
    out.integer(one.part + 1);
  }
}

/// Numbers of nodes, elements and parts in the deck; in front where the lists begin, and how long they are.
void add_numbers(const D3plotMesh& mesh, Words& out) {
  const std::size_t nodes = mesh.node_ids.size(), solids = mesh.solids.size(), beams = mesh.beams.size(),
                    shells = mesh.shells.size(), parts = mesh.parts.size();
  const auto number = [&](std::size_t value) { out.integer(static_cast<std::int64_t>(value)); };
  std::size_t at = 1;
  out.integer(-static_cast<std::int64_t>(at));  // < 0: parts have numbers, too
  for (const std::size_t list : {nodes, solids, beams, shells}) number(at += list);
  for (const std::size_t size : {nodes, solids, beams, shells, std::size_t{0}}) number(size);
  for (int k = 0; k < 3; ++k) number(at), at += parts;
  number(parts), number(0), number(parts);
  for (const Id id : mesh.node_ids) out.integer(id);
  for (const auto* list : {&mesh.solids, &mesh.beams, &mesh.shells})
    for (const D3plotElement& one : *list) out.integer(one.id);
  for (int k = 0; k < 2; ++k)
    for (const D3plotPart& part : mesh.parts) out.integer(part.id);
  for (std::size_t k = 1; k <= parts; ++k) number(k);
}

/// Behind the end mark: titles have 72 bytes whatever the width of a word.
void add_titles(const D3plotMesh& mesh, Words& out) {
  constexpr std::size_t width = 72;
  out.real(d3plot_end);
  out.integer(90001);
  out.integer(static_cast<std::int64_t>(mesh.parts.size()));
  for (const D3plotPart& part : mesh.parts) {
    out.integer(part.id);
    out.text(part.title, width);
  }
  out.integer(90000);
  out.text(mesh.title, width);
  out.real(d3plot_end);
}

}  // namespace

std::string D3plotModel::head(const World& world) const {
  Words out = control_words(mesh_, extent_, global_words(world), may_delete());
  if (!mesh_.particles.empty()) {
    out.integer(10);
    for (const int words : words_of_particle) out.integer(words);
  }
  for (const Vec& place : mesh_.places) out.vec(place);
  add_elements(mesh_.solids, 8, 0, out);
  add_elements(mesh_.beams, 2, 3, out);
  add_elements(mesh_.shells, 4, 0, out);
  add_numbers(mesh_, out);
  add_elements(mesh_.particles, 1, 0, out);
  add_titles(mesh_, out);
  return out.take();
}

std::size_t D3plotModel::state_bytes(const World& world) const {
  const auto words = [](std::size_t count, int each) { return count * static_cast<std::size_t>(each); };
  std::size_t n = 1 + global_words(world) + 9 * mesh_.node_ids.size();
  n += words(mesh_.solids.size(), extent_.words_of_solid());
  n += words(mesh_.beams.size(), extent_.words_of_beam());
  n += words(mesh_.shells.size(), extent_.words_of_shell());
  if (may_delete()) n += elements();
  n += 20 * mesh_.particles.size();
  return n * (extent_.bits == 64 ? 8 : 4);
}

}  // namespace courant
