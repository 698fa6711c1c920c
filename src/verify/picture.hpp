#pragma once
// A picture of the particles of a run.
#include <filesystem>
#include <optional>

#include "generate/expression.hpp"
#include "verify/results.hpp"

namespace courant {

/// The particles of the state at SuiteCase::picture_at (the last one if blank), in colours by picture_of,
/// seen along -z (in 3D along the direction in which they extend least). Each point of the picture has the
/// colour of the nearest particle within 0.75 h, white where there is none; the scale goes from the 1st to
/// the 99th percentile. Nothing if the run has no such state.
std::optional<ReportPicture> draw_particles(const SuiteCase& definition, const Variables& variables,
                                            const std::filesystem::path& folder);

}  // namespace courant
