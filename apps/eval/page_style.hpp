// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace geoloc::apps {

/// Rules for the report's page, besides those for its pictures (chart_css()) and its colours.
inline constexpr const char* kPageStyle =
    R"(*{box-sizing:border-box}body{margin:0;background:var(--page);color:var(--ink);font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,"Helvetica Neue",Arial,sans-serif}
main{max-width:1900px;margin:0 auto;padding:28px 16px 64px}h1{font-size:1.75rem;line-height:1.2;margin:0 0 6px}
h2{font-size:1.2rem;margin:44px 0 4px}p{margin:6px 0 14px;max-width:90ch}code{overflow-wrap:anywhere}pre{overflow-x:auto}.lead{color:var(--soft)}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(150px,1fr));gap:12px;margin:22px 0 8px}
.tile{background:var(--card);border:1px solid var(--line);border-radius:10px;padding:12px 14px}
.tile b{display:block;font-size:1.45rem;line-height:1.25;font-variant-numeric:tabular-nums}.tile.ours b{color:var(--best)}
.tile span{display:block;font-size:.82rem;color:var(--soft)}
.scroll{overflow-x:auto;margin:10px 0 18px}table{border-collapse:collapse;font-size:.875rem;font-variant-numeric:tabular-nums;min-width:100%}
caption{text-align:left;font-weight:600;padding:4px 0}th,td{padding:5px 9px;text-align:right;white-space:nowrap;border-bottom:1px solid var(--line)}
th:first-child{text-align:left;padding-left:0}thead th{color:var(--soft);font-weight:500;vertical-align:bottom;white-space:normal;line-height:1.25}tbody th{font-weight:500}
.charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,340px),1fr));gap:18px;margin:14px 0}
.charts figure{margin:0;background:var(--card);border:1px solid var(--line);border-radius:10px;padding:10px 8px}
@media (max-width:600px){table{font-size:.75rem}th,td{padding:5px 4px}}
.gc{display:block;width:100%;height:auto}
)";

}  // namespace geoloc::apps
