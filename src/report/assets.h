// The fixed parts of pages: the files of assets/, put into the program when it is built.
#pragma once

#include <string_view>

namespace filigree::report {

extern const std::string_view page_css;  // every page
extern const std::string_view page_js;

extern const std::string_view map_view_css;  // pages with a MapView, in this order
extern const std::string_view curve_js;
extern const std::string_view cells_js;
extern const std::string_view copies_js;
extern const std::string_view raster_js;
extern const std::string_view stage_js;
extern const std::string_view costs_js;
extern const std::string_view panel_js;
extern const std::string_view map_view_js;

}  // namespace filigree::report
