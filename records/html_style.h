// SPDX-License-Identifier: MIT
// The look of every report. System fonts and no script, so that the page is one file and reads the
// same in years.
#pragma once

#include <string_view>

namespace records {

inline constexpr std::string_view kHtmlStyle = R"css(
:root {
  color-scheme: light dark;
  --ground: #fbfbfa; --ink: #1f2328; --quiet: #5b636d; --line: #dfe2e6; --raised: #f1f3f5;
  --accent: #1f5fa8; --paper: #fff; --shade: rgba(0, 0, 0, .22); --over-shade: darken; --note: #fff6df; --note-line: #d9a520;
}
@media (prefers-color-scheme: dark) {
  :root {
    --ground: #16191d; --ink: #e4e7eb; --quiet: #9aa4af; --line: #343a42; --raised: #20252b;
    --accent: #82b4f0; --note: #2b2616; --note-line: #b8922f;
  }
}
@media screen and (prefers-color-scheme: dark) {
  :root { --paper: #1a1a1a; --shade: rgba(255, 255, 255, .22); --over-shade: lighten; } /* what the filter makes of white */
  .paper svg { filter: invert(0.9) hue-rotate(180deg); }
}
* { box-sizing: border-box; }
html { -webkit-text-size-adjust: 100%; text-size-adjust: 100%; }
body {
  margin: 0; background: var(--ground); color: var(--ink);
  font: 1rem/1.6 system-ui, -apple-system, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif;
}
main { max-width: 62rem; margin: 0 auto; padding: 2.5rem 1.25rem 4rem; }
h1, h2, h3 { line-height: 1.25; text-wrap: balance; }
h1 { font-size: 2rem; margin: 0 0 1.5rem; letter-spacing: -.01em; }
h2 { font-size: 1.35rem; margin: 3rem 0 .75rem; padding-top: 1.25rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 2rem 0 .5rem; }
p { margin: 0 0 1rem; max-width: 46rem; overflow-wrap: break-word; }
.headline {
  margin: 0 0 2rem; padding: 1.1rem 1.4rem; background: var(--raised);
  border-left: 4px solid var(--accent); border-radius: 0 8px 8px 0;
}
.headline .value {
  margin: 0; max-width: none; font-size: clamp(1.4rem, 5vw, 2.1rem); font-weight: 650; line-height: 1.25;
  letter-spacing: -.01em; font-variant-numeric: tabular-nums;
}
.headline .meaning { margin: .35rem 0 0; color: var(--quiet); }
.note {
  padding: .65rem 1rem; background: var(--note); border-left: 4px solid var(--note-line);
  border-radius: 0 6px 6px 0;
}
.failure {
  padding: .8rem 1rem; background: #b3261e; color: #fff; font-weight: 650; border-radius: 6px;
}
figure { margin: 1.5rem 0 2rem; }
figcaption { margin-top: .5rem; color: var(--quiet); font-size: .9rem; line-height: 1.5; max-width: 46rem; }
figure img { display: block; max-width: 100%; height: auto; border-radius: 6px; border: 1px solid var(--line); }
.paper {
  padding: .75rem; background: var(--paper); border: 1px solid var(--line); border-radius: 8px; overflow-x: auto;
}
dl { margin: 0 0 1.5rem; display: grid; grid-template-columns: minmax(6rem, 9rem) minmax(0, 46rem); gap: .6rem 1.25rem; }
dt { font-weight: 600; }
dd { margin: 0; overflow-wrap: break-word; }
.paper svg { display: block; margin: 0 auto; max-width: 100%; height: auto; }
.gallery { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); gap: 1.25rem; margin: 1.5rem 0 2rem; }
.gallery figure { margin: 0; }
.gallery img { width: 100%; }
.table figcaption { margin: 0 0 .5rem; }
.scroll { overflow: auto; max-height: 44rem; border: 1px solid var(--line); border-radius: 8px; width: fit-content; max-width: 100%; }
.scroll:focus-visible { outline: 2px solid var(--accent); outline-offset: 2px; }
table { border-collapse: collapse; font-size: .92rem; line-height: 1.4; font-variant-numeric: tabular-nums; }
th, td { padding: .45rem .9rem; text-align: left; vertical-align: top; }
td { border-top: 1px solid var(--line); }
th { font-weight: 600; background: var(--raised); vertical-align: bottom; position: sticky; top: 0; }
.number { text-align: right; white-space: nowrap; }
tbody tr:hover { background: var(--raised); }
pre {
  margin: 1rem 0 1.5rem; padding: .9rem 1.1rem; overflow: auto; max-height: 24rem; background: var(--raised); border-radius: 8px;
  font: .85rem/1.5 ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace;
}
@media (max-width: 34rem) {
  main { padding: 1.5rem 1rem 3rem; }
  h1 { font-size: 1.6rem; }
  h2 { margin-top: 2.25rem; }
  th, td { padding: .4rem .6rem; }
  td:not(.number) { min-width: 8rem; }
  .paper { padding: .35rem; }
  dl { grid-template-columns: 1fr; gap: .1rem; }
  dd { margin-bottom: .7rem; }
  .paper svg { min-width: 34rem; } /* scrolls, rather than shrinking its lettering beyond reading */
  .paper, .scroll { /* shaded at the side where more of it lies */
    background:
      linear-gradient(to right, var(--paper) 40%, transparent) 0 0 / 3rem 100% no-repeat local,
      linear-gradient(to left, var(--paper) 40%, transparent) 100% 0 / 3rem 100% no-repeat local,
      linear-gradient(to right, var(--shade), transparent) 0 0 / 1rem 100% no-repeat scroll,
      linear-gradient(to left, var(--shade), transparent) 100% 0 / 1rem 100% no-repeat scroll,
      var(--paper);
    isolation: isolate;
  }
  .paper svg { mix-blend-mode: var(--over-shade); } /* its ground would cover the shade */
}
@media print {
  :root {
    color-scheme: light; --ground: #fff; --ink: #000; --quiet: #444; --line: #bbb; --raised: #f4f4f4;
    --note: #fff; --accent: #000; --note-line: #000;
  }
  body { font-size: 10.5pt; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  main { max-width: none; padding: 0; }
  h2, h3, .table figcaption { break-after: avoid; }
  .headline, .note, figure:not(.table), figcaption, tr, dt, dd { break-inside: avoid; }
  thead { display: table-header-group; }
  .scroll { overflow: visible; max-height: none; border: 0; width: auto; }
  .gallery { grid-template-columns: 1fr 1fr; }
  .paper svg { max-height: 20cm; max-width: 15cm; margin: 0; } /* two of usual shape on a page */
  .paper { padding: 0; border: 0; overflow: visible; }
  table { font-size: .82rem; }
  th, td { padding: .2rem .5rem; }
  pre { max-height: none; white-space: pre-wrap; overflow-wrap: anywhere; }
}
)css";

}  // namespace records
