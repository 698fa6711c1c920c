// The colours are those of Okabe and Ito, "Color Universal Design" (2008), which people with any kind of
// colour blindness can tell apart, darkened or lightened where they would be pale on the page.
#include "verify/svg_chart.hpp"

namespace courant::report {

std::string_view chart_style() {
  return R"(
.chart{font:13.5px/1 system-ui,-apple-system,"Segoe UI","Liberation Sans",Arial,sans-serif}
.chart text{fill:#222}
.chart .paper{fill:#fff}
.chart path,.chart circle{fill:none}
.chart .grid path{stroke:#e2e2e2;stroke-width:1}
.chart .frame{stroke:#777;stroke-width:1}
.chart .line{stroke:currentColor;stroke-width:1.8;stroke-linejoin:round}
.chart .mark{fill:currentColor;stroke:#fff;stroke-width:.6;vector-effect:non-scaling-stroke}
.chart .arrow{stroke:currentColor;stroke-width:1.5}
.chart .again .line{stroke-dasharray:7 3}
.chart .reference .line{stroke:#222;stroke-width:1.6;stroke-dasharray:5 4}
.chart .dots circle{stroke:#222;stroke-width:1.4}
.chart .bound{stroke:#b00020;stroke-width:1.6;stroke-dasharray:2 4;stroke-linecap:round}
.chart .front path{stroke:#d9b300;stroke-width:9;stroke-linecap:round;stroke-linejoin:round;opacity:.35}
.chart .front circle{stroke:#a88600;stroke-width:1.8}
.chart .s0{color:#0072b2}.chart .s1{color:#d55e00}.chart .s2{color:#008060}.chart .s3{color:#b0518a}
.chart .s4{color:#b87a00}.chart .s5{color:#3a9bdc}.chart .s6{color:#666}
.chart .cell{stroke:#fff;stroke-width:2}
.chart .cell-stable{fill:#a6d4f0}.chart .cell-degraded{fill:#f5e07a}.chart .cell-stopped{fill:#eb9a5c}
.chart .cell-refused{fill:#c9c9c9}.chart .cell-broken{fill:#222}.chart .cell-none{fill:#f4f4f4}
.chart .fault{fill:none;stroke:#b00020;stroke-width:3}
.chart .on-cell text,.chart text.on-cell{fill:#111}.chart text.on-broken{fill:#fff}
.chart .symbol{font-weight:700}
@media screen and (prefers-color-scheme:dark){
.chart text{fill:#e4e4e4}
.chart .paper{fill:#16191d}
.chart .grid path{stroke:#33383f}
.chart .frame{stroke:#8a8f96}
.chart .mark{stroke:#16191d}
.chart .reference .line,.chart .dots circle{stroke:#e4e4e4}
.chart .bound{stroke:#ff7a85}
.chart .front path{stroke:#ffd84d;opacity:.28}
.chart .front circle{stroke:#ffd84d}
.chart .s0{color:#58b4ec}.chart .s1{color:#ff9550}.chart .s2{color:#2fc79b}.chart .s3{color:#e49ac8}
.chart .s4{color:#f0b93a}.chart .s5{color:#9cd2f7}.chart .s6{color:#b5b5b5}
.chart .cell{stroke:#16191d}
.chart .cell-broken{fill:#000;stroke:#e4e4e4}.chart .cell-none{fill:#2a2f35}
.chart .fault{stroke:#ff7a85}
.chart text.on-none{fill:#e4e4e4}
})";
}

}  // namespace courant::report
