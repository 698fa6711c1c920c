#pragma once
// Builds with COURANT_CHECK_ACCESSES check the declared accesses of every pass; other builds have no cost.
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

/// Calls `work`, a function of the entry's pass. Throws std::logic_error, which names pass and resource, at
/// an access or a change that it has not declared.
void run_checked(const StagePlan::Entry& entry, Access::When when, const World& world,
                 const std::function<void()>& work);

/// The same for block [begin, end): fields declared as own only are NaN at other entities while it runs.
void run_block_checked(const StagePlan::Entry& entry, World& world, Index begin, Index end,
                       const std::function<void()>& work);

/// Omits a declaration from schedules made from now on, to test that its absence is detected; two empty
/// names: none.
void leave_out_declaration(const std::string& pass, const std::string& resource);
/// The omitted declaration: pass and resource.
const std::pair<std::string, std::string>& left_out_declaration();

}  // namespace courant
