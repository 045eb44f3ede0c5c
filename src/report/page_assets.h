// The fixed parts of a page: head, style and script.
#pragma once

namespace filigree::report {

// Nothing may be fetched: pictures are data URIs, style and script stand in the page.
inline constexpr const char* pageHead = R"(<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
)";

inline constexpr const char* pageStyle = R"(
:root{--bg:#fff;--text:#1b1f24;--faint:#57606a;--line:#d0d7de;--soft:#f4f6f8;--link:#0058a8}
@media (prefers-color-scheme:dark){
:root{--bg:#12161b;--text:#e6edf3;--faint:#9aa6b2;--line:#3a424c;--soft:#1b2128;--link:#6cb6ff}}
*{box-sizing:border-box}
html{-webkit-text-size-adjust:100%}
body{margin:0;background:var(--bg);color:var(--text);
font:16px/1.55 system-ui,-apple-system,"Segoe UI",Roboto,"DejaVu Sans",sans-serif}
main{max-width:76rem;margin:0 auto;padding:1.5rem clamp(1rem,4vw,3rem) 4rem}
h1{font-size:1.9rem;line-height:1.2;margin:.5rem 0}
h2{font-size:1.35rem;margin:2.6rem 0 .8rem;padding-top:.8rem;border-top:1px solid var(--line)}
h1,h2,p,li,figcaption{overflow-wrap:anywhere}
p{max-width:70ch}
.lead{color:var(--faint);margin-top:0}
a{color:var(--link)}
nav ul,ul.legend{list-style:none;display:flex;flex-wrap:wrap;gap:.3rem 1.2rem;padding:0;margin:1rem 0}
ul.legend i{display:inline-block;width:.95em;height:.95em;margin-right:.5em;vertical-align:-.1em;
border:1px solid var(--faint);border-radius:3px}
figure{margin:1.2rem 0 1.6rem;min-width:0}
figure>a{display:block}
figure img{display:block;max-width:100%;max-height:min(90vh,50rem);width:auto;height:auto;border:1px solid var(--line);border-radius:4px}
figcaption{color:var(--faint);margin-top:.5rem;max-width:76ch}
figure>code{display:block;margin-top:.4rem;padding:.4rem .7rem;background:var(--soft);border-radius:4px;
font:13px/1.5 ui-monospace,"DejaVu Sans Mono",Consolas,monospace;overflow-x:auto;white-space:pre}
.row{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,27rem),1fr));gap:0 2rem}
.scroll{overflow-x:auto}
svg.fg{display:block;min-width:26rem}
figure.table{width:fit-content;max-width:100%}
figure.table figcaption{display:flex;flex-wrap:wrap;gap:.4rem 1rem;align-items:center;justify-content:space-between;
margin:0 0 .4rem;max-width:none}
table{border-collapse:collapse;font-size:.92rem;font-variant-numeric:tabular-nums}
th,td{padding:.35rem .6rem;text-align:left;border-bottom:1px solid var(--line);vertical-align:top}
th{font-weight:600;background:var(--soft)}
td.n,th.n{text-align:right}
td.n{white-space:nowrap}
button.copy{font:inherit;font-size:.85rem;padding:.15rem .7rem;color:var(--text);background:var(--soft);
border:1px solid var(--line);border-radius:4px;cursor:pointer}
@media print{button.copy{display:none}}
)";

// Copies a table's CSV; the older way serves browsers that keep the clipboard from local files.
inline constexpr const char* pageScript = R"(
for(const button of document.querySelectorAll('button.copy')){
button.hidden=false;
button.addEventListener('click',async()=>{
let done=true;
try{await navigator.clipboard.writeText(button.dataset.csv);}
catch{
const area=document.createElement('textarea');
area.value=button.dataset.csv;document.body.append(area);area.select();
done=document.execCommand('copy');area.remove();}
const before=button.textContent;
button.textContent=done?'Copied':'Could not copy';
setTimeout(()=>{button.textContent=before;},1500);});}
)";

}  // namespace filigree::report
