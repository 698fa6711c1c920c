#pragma once
// The accesses that a pass declares. Stages, barriers and the exchange of ghosts follow from them
// (time/schedule.hpp).
#include <string>
#include <vector>

namespace courant {

class FieldBase;

/// Data that passes read and write: a field of an entity set, or numbers that a pass keeps beside fields.
/// `set`: the name of its entity set; "" for numbers of no set.
class Resource {
 public:
  explicit Resource(std::string name, std::string set = "") : name_(std::move(name)), set_(std::move(set)) {}
  virtual ~Resource() = default;
  const std::string& name() const { return name_; }
  const std::string& set() const { return set_; }
  /// The field that holds it now; null where none does. It may change: PairVolumes alternates between two.
  virtual const FieldBase* field() const { return nullptr; }

 private:
  std::string name_, set_;
};

/// The only prescribed order of passes; the rest follows from accesses. Within a phase the pass that writes a
/// resource comes first, then those that add to it, revise the sum and read it.
enum class Phase {
  rates,        ///< from x and v of the last motion; velocities of neighbours
  laws,         ///< density, energy and stress advance; corner forces of elements
  reductions,   ///< sums and searches once laws are known
  forces,       ///< forces that need pressures and stresses of neighbours; external forces
  constraints,  ///< changes of forces once all are known
  drive,        ///< after dt is chosen: velocities that are prescribed
  motion,       ///< v += a dt, x += v dt
  relocation,   ///< other changes of positions: drift, reflection
  preparation,  ///< values that the next step reads of neighbours
};
const char* name_of(Phase phase);

/// The entities whose values a pass reads. Values of another set than that of the pass are always `others`.
enum class Reach {
  own,     ///< of the entities of its block
  others,  ///< of neighbours, corners, elements of a node, ...
};

struct Access {
  enum class Mode {
    reads_before,  ///< as it was before this phase; passes that change it in this phase come later
    writes,        ///< all of it, independent of its old value
    updates,       ///< adds to it, or changes some entities of it
    revises,       ///< changes it after all additions
    reads,         ///< after all changes in this phase
  };
  enum class When { start, block, finish };  ///< in which function of the pass
  const Resource* what = nullptr;
  Mode mode = Mode::reads;
  Reach reach = Reach::own;
  When when = When::block;
  bool changes() const { return mode == Mode::writes || mode == Mode::updates || mode == Mode::revises; }
};

/// The declarations of one pass, as BlockPass::declare makes them.
class Accesses {
 public:
  Accesses& reads(const Resource& r, Reach reach = Reach::own) { return add(r, Access::Mode::reads, reach); }
  Accesses& reads_before(const Resource& r, Reach reach = Reach::own) {
    return add(r, Access::Mode::reads_before, reach);
  }
  Accesses& writes(const Resource& r) { return add(r, Access::Mode::writes, Reach::own); }
  Accesses& updates(const Resource& r) { return add(r, Access::Mode::updates, Reach::own); }
  Accesses& revises(const Resource& r) { return add(r, Access::Mode::revises, Reach::own); }
  /// The following accesses are made in BlockPass::start, `finish` or `block`.
  Accesses& in_start() { return in(Access::When::start); }
  Accesses& in_finish() { return in(Access::When::finish); }
  Accesses& in_block() { return in(Access::When::block); }
  const std::vector<Access>& all() const { return all_; }
  /// Removes those of a resource, for the test that each declaration is needed.
  void drop(const std::string& resource);

 private:
  Accesses& add(const Resource& r, Access::Mode mode, Reach reach) {
    all_.push_back({&r, mode, reach, when_});
    return *this;
  }
  Accesses& in(Access::When when) {
    when_ = when;
    return *this;
  }
  Access::When when_ = Access::When::block;
  std::vector<Access> all_;
};

#ifdef COURANT_CHECK_ACCESSES
/// In builds that check declarations: called at each access to the values of a resource. If the running pass
/// has not declared it, the run stops with a std::logic_error after the pass.
void note_access(const Resource& resource);
#else
inline void note_access(const Resource&) {}
#endif

/// During its lifetime accesses are not checked: values read only for an error message (ids, positions) are
/// not declared, so that no other pass waits for them.
class ReadsForMessage {
 public:
#ifdef COURANT_CHECK_ACCESSES
  ReadsForMessage();
  ~ReadsForMessage();

 private:
  const void* at_work_;
#else
  ReadsForMessage() {}
  ~ReadsForMessage() {}
#endif
  ReadsForMessage(const ReadsForMessage&) = delete;
  ReadsForMessage& operator=(const ReadsForMessage&) = delete;
};

}  // namespace courant
