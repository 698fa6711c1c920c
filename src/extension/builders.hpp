#pragma once
// From deck to world: every folder registers builders. A builder is a function whose parameters state what it
// reads (const T&) and fills (T&). Within a phase all builders that fill a T come before those that read it.
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <typeindex>
#include <utility>
#include <vector>

#include "extension/left_out.hpp"
#include "keyword/deck.hpp"
#include "model/model.hpp"
#include "state/world.hpp"

namespace courant {

/// Values that builders pass to each other and to the run, one of each type.
class Assembly {
 public:
  /// Created empty if it does not exist.
  template <class T>
  T& of() {
    std::shared_ptr<void>& value = values_[typeid(T)];
    if (!value) value = std::make_shared<T>();
    return *static_cast<T*>(value.get());
  }
  /// An empty one if no builder requested it.
  template <class T>
  const T& get() const {
    static const T none{};
    const auto at = values_.find(typeid(T));
    return at == values_.end() ? none : *static_cast<const T*>(at->second.get());
  }
  /// Inserts a value that is owned elsewhere and lives longer.
  template <class T>
  void lend(T& value) {
    values_[typeid(T)] = std::shared_ptr<void>(std::shared_ptr<void>(), &value);
  }
  template <class T>
  void drop() {
    values_.erase(typeid(T));
  }

 private:
  std::map<std::type_index, std::shared_ptr<void>> values_;
};

/// The only prescribed order; the rest follows from the values that builders fill and read, then from their
/// names.
enum class BuildPhase {
  model,        ///< additions to the model, such as inlets
  parts,        ///< materials and sections
  particles,    ///< and the settings of their scheme
  nodes,        ///< of the world, and its shell faces
  elements,     ///< masses of nodes, passes of elements
  bodies,       ///< rigid bodies; scaled and rotary masses of nodes
  ties,         ///< that constrain nodes
  settings,     ///< of particles, which need faces and bodies
  conditions,   ///< loads, prescribed motion, rigid walls
  flow,         ///< passes over particles
  body_passes,  ///< passes over bodies, pressure on faces; additions by single files
  faces,        ///< contact of nodes with faces and of edges
  joints,       ///< constraints between bodies and between nodes
  node_passes,  ///< from forces of elements to the motion of nodes
  checks,       ///< of the complete world
};

/// A value that exists from the start, or to which all may add: defines no order.
template <class T>
inline constexpr bool sets_order = true;
template <>
inline constexpr bool sets_order<Deck> = false;
template <>
inline constexpr bool sets_order<Model> = false;
template <>
inline constexpr bool sets_order<World> = false;
template <>
inline constexpr bool sets_order<Diagnostics> = false;
template <>
inline constexpr bool sets_order<LeftOut> = false;

struct WorldBuilder {
  BuildPhase phase;
  std::string name;
  bool goes_on = false;  ///< also runs if the deck has errors, to report more of them
  std::vector<std::type_index> fills{}, reads{};
  std::function<void(Assembly&)> run{};
};

std::vector<WorldBuilder>& world_builders();
/// The builders of `all` in the order of execution. Throws std::logic_error, which names them, if they wait
/// for each other.
std::vector<const WorldBuilder*> in_order(const std::vector<WorldBuilder>& all);
/// Runs all builders of phases `from` to `to`, both included.
void build(Assembly& assembly, BuildPhase from, BuildPhase to);

enum class Errors { stop, go_on };

class RegisterBuilder {
 public:
  template <class... Parameters>
  RegisterBuilder(BuildPhase phase, std::string name, void (*function)(Parameters...),
                  Errors errors = Errors::stop) {
    static_assert((std::is_lvalue_reference_v<Parameters> && ...), "builders take references");
    WorldBuilder builder{phase, std::move(name), errors == Errors::go_on};
    (note<std::remove_reference_t<Parameters>>(builder), ...);
    builder.run = [function](Assembly& all) { function(all.of<std::remove_cvref_t<Parameters>>()...); };
    world_builders().push_back(std::move(builder));
  }

 private:
  template <class T>
  static void note(WorldBuilder& builder) {
    if constexpr (sets_order<std::remove_const_t<T>>)
      (std::is_const_v<T> ? builder.reads : builder.fills).push_back(typeid(T));
  }
};

}  // namespace courant
