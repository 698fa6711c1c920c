#pragma once

namespace courant {

/// Starts the program over once with what libraries read only at start, unless the user has chosen it:
/// - threads that soon sleep instead of spinning on when they wait for each other (OMP_WAIT_POLICY,
///   GOMP_SPINCOUNT). On a machine busy with other work, spinning threads take the time slices of those they
///   wait for.
/// - memory in large pages, where the system offers them (GLIBC_TUNABLES).
/// COURANT_STARTED_OVER in the environment says that this is done. Figures: docs/performance.md.
void start_over_for_speed(char** argv);

}  // namespace courant
