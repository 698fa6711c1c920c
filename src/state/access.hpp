#pragma once
// What a pass says it touches. Stages, waiting and the exchange of ghosts follow from it (time/schedule.hpp).
#include <string>
#include <vector>

namespace courant {

class FieldBase;

/// Something that passes read and write: a field of an entity set, or numbers that a physics keeps beside
/// fields. `set`: the name of the entity set that it belongs to; "" for numbers that belong to none.
class Resource {
 public:
  explicit Resource(std::string name, std::string set = "") : name_(std::move(name)), set_(std::move(set)) {}
  virtual ~Resource() = default;
  const std::string& name() const { return name_; }
  const std::string& set() const { return set_; }
  /// The field that holds it now; null where none does. Not always the same one: PairVolumes takes turns.
  virtual const FieldBase* field() const { return nullptr; }

 private:
  std::string name_, set_;
};

/// The only order of passes that is given; the rest follows from accesses. Within a phase, of one resource,
/// who writes it comes first, then who adds to it, then who revises the sum, then who reads it.
enum class Phase {
  rates,        ///< from x and v of the last motion; velocities of neighbours
  laws,         ///< density, energy and stress advance; corner forces of elements
  reductions,   ///< sums and searches once laws are known
  forces,       ///< what needs pressures and stresses of neighbours; external forces
  constraints,  ///< changes of forces once all are known
  drive,        ///< after dt is chosen: velocities that are prescribed
  motion,       ///< v += a dt, x += v dt
  relocation,   ///< places that change besides: drift, reflection
  preparation,  ///< what the next step reads of neighbours
};
const char* name_of(Phase phase);

/// Whose values a pass looks at. What belongs to another set than the pass's own is always `others`.
enum class Reach {
  own,     ///< of the entities of the block that it works on
  others,  ///< of neighbours, corners, elements of a node, ...
};

struct Access {
  enum class Mode {
    reads_before,  ///< as it was before this phase; who changes it in this phase comes later
    writes,        ///< all of it, whatever it was
    updates,       ///< adds to it, or changes some entities of it
    revises,       ///< changes it once all have added
    reads,         ///< once all in this phase have changed it
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
  /// What follows happens in BlockPass::start, `finish` or `block`.
  Accesses& in_start() { return in(Access::When::start); }
  Accesses& in_finish() { return in(Access::When::finish); }
  Accesses& in_block() { return in(Access::When::block); }
  const std::vector<Access>& all() const { return all_; }
  /// Without those of a resource: for the test that each declaration is needed.
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
/// Builds that check declarations: called wherever a resource's values are asked for. Where the pass at work
/// has not declared it, the run stops with a std::logic_error once the pass is done.
void note_access(const Resource& resource);
#else
inline void note_access(const Resource&) {}
#endif

/// While it lives, nothing is held against the pass at work: what only the message of a fault reads (ids,
/// places) is not declared, so that no other pass waits for it.
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
