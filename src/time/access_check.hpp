#pragma once
// Builds with COURANT_CHECK_ACCESSES hold every pass to what it declared: other builds pay nothing.
#include <functional>
#include <string>
#include <utility>

#include "state/world.hpp"
#include "time/schedule.hpp"

namespace courant {

#ifdef COURANT_CHECK_ACCESSES
inline constexpr bool checks_accesses = true;
#else
inline constexpr bool checks_accesses = false;
#endif

/// Calls `work`, a function of the entry's pass. Throws std::logic_error, which names pass and resource,
/// where it asks for what it has not declared, or changes what it has not declared to change.
void run_checked(const StagePlan::Entry& entry, Access::When when, const World& world,
                 const std::function<void()>& work);

/// The same for block [begin, end): what others have of fields declared as its own alone is no number while
/// it runs.
void run_block_checked(const StagePlan::Entry& entry, World& world, Index begin, Index end,
                       const std::function<void()>& work);

/// Leaves a declaration out of schedules made from now on, to see that it is missed; two empty names: none.
void leave_out_declaration(const std::string& pass, const std::string& resource);
/// What is left out: pass and resource.
const std::pair<std::string, std::string>& left_out_declaration();

}  // namespace courant
