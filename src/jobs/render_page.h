// One page on a picture: what it shows, what its rays cost, and other methods beside it.
#pragma once

#include "filigree/core/result.h"
#include "filigree/jobs/render.h"
#include "filigree/report/page.h"

#include "jobs/render_beside.h"

#include <vector>

namespace filigree::jobs {

// The first is the method that was asked for; the reference, the texture alone, is among them where maps are
// compared with it.
Result<report::Page> renderPage(const RenderOptions& options, const RenderSummary& summary,
                                const std::vector<MethodFilm>& films);

}  // namespace filigree::jobs
