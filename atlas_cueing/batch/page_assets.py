"""Style sheet and script of the overview."""

STYLE = """
:root{color-scheme:light dark;--grey:light-dark(#667380,#98a4b0);--line:#8883;
--bar:light-dark(#8fbdec,#356596)}
body{font:14px/1.4 system-ui,sans-serif;margin:1.2em auto;max-width:1180px;padding:0 14px;
color:light-dark(#1b2733,#e2e8ee)}
body{background:light-dark(#fff,#14181d)}a{color:light-dark(#1763b0,#7db8f5);text-decoration:none}
a:hover{text-decoration:underline}
h1{font-size:1.5em;margin:.2em 0;overflow-wrap:anywhere}
h2{font-size:1.1em;margin:1.6em 0 .4em}p{color:var(--grey);margin:.4em 0}
.totals{display:flex;flex-wrap:wrap;gap:10px;margin:.8em 0}
.totals div{border:1px solid var(--line);border-radius:8px;padding:5px 16px}
.totals b{white-space:nowrap;display:block;font-size:1.5em;font-weight:600;line-height:1.2}
.totals span,small{color:var(--grey);font-size:12px}
.totals .good b{color:light-dark(#2e7d32,#74c27a)}
.totals .bad b,tr.bad .violations,td.result{color:light-dark(#c00000,#ff8a80)}
svg{display:block;max-width:100%;height:auto;margin:.6em 0 1em}
table{border-collapse:separate;border-spacing:0;width:100%}small{font-weight:normal}
td small{font-size:11px}
th,td{padding:3px 9px;text-align:right;border-bottom:1px solid var(--line);
font-variant-numeric:tabular-nums}
td{overflow-wrap:anywhere}
th{position:sticky;top:0;background:light-dark(#f3f5f7,#20262d);vertical-align:bottom}
th{line-height:1.25;cursor:pointer;font-weight:600}
th small{display:block}th:first-child,td:first-child,.text{text-align:left}
td.text{min-width:6em}td.run{min-width:17em}td.run small{margin-left:6px;white-space:nowrap}
th:last-child{cursor:default}td:last-child{white-space:nowrap}
th[aria-sort=ascending] span::after{content:" ▲";font-size:9px}
th[aria-sort=descending] span::after{content:" ▼";font-size:9px}
td.figure{background:linear-gradient(90deg,var(--bar) var(--part,0%),transparent 0)
9px 100%/calc(100% - 18px) 3px no-repeat}
td.least{font-weight:700}tr:hover td{background-color:#8881}td.reason{width:50%}
.dense{font-size:12px}.dense th{overflow-wrap:anywhere}.dense td,.dense th{padding:2px 4px}
.dense .text,.dense td.run{min-width:0}.dense td:last-child{white-space:normal}
"""
"""Fits a window of 1200 px; dark where the reader's browser is."""

# Numbers by size, names by letters; what is empty stays last either way.
SCRIPT = """
document.querySelectorAll("th:not(:last-child)").forEach(head=>{
head.tabIndex=0;head.onkeydown=event=>event.key==="Enter"&&head.click();
head.onclick=()=>{
const body=head.closest("table").tBodies[0],up=head.ariaSort!=="ascending",
v=row=>row.cells[head.cellIndex].dataset.v;
for(const other of head.parentNode.cells)other.removeAttribute("aria-sort");
head.setAttribute("aria-sort",up?"ascending":"descending");
[...body.rows].sort((a,b)=>{const p=v(a),q=v(b);if(p===""||q==="")return(p==="")-(q==="");
const d=isNaN(p)||isNaN(q)?p.localeCompare(q):p-q;return up?d:-d}).forEach(row=>body.append(row))}})
"""
"""A click on a head (or Enter) sorts its table by that column, another one the other way round.

The last column is of links.
"""
