"""All runs of a batch on one page for a browser, without anything from elsewhere."""

from collections import Counter
from collections.abc import Collection, Sequence
from html import escape
from typing import Any
from urllib.parse import quote

from .picture import parameters, picture
from .table import Row

_STYLE = """
body{font:14px/1.4 system-ui,sans-serif;margin:1.5em;color-scheme:light dark}
table{border-collapse:collapse}th,td{padding:2px 9px;text-align:right;border-bottom:1px solid #8884;white-space:nowrap}
th{cursor:pointer;position:sticky;top:0;background:Canvas}td.text,th.text{text-align:left}
td.reason{white-space:normal;min-width:20em}tr.bad td.result{color:#c22;font-weight:bold}
"""
# A click on a head sorts by that column, another click the other way round; what is empty stays last.
_SCRIPT = """
document.querySelectorAll("th").forEach((head,i)=>head.onclick=()=>{
const body=document.querySelector("tbody"),up=head.dataset.up=head.dataset.up==="1"?"0":"1",v=r=>r.cells[i].dataset.v;
[...body.rows].sort((a,b)=>{const p=v(a),q=v(b);if(p===""||q==="")return (p==="")-(q==="");
const d=isNaN(p)||isNaN(q)?p.localeCompare(q):p-q;return up==="1"?d:-d}).forEach(r=>body.append(r))})
"""
_TEXTS = ("run", "source", "scenario", "vehicle", "method", "platform", "result", "reason", "review")


def overview(table: Sequence[Row], settings: Sequence[str], metrics: Sequence[str], title: str, files: Collection[str]) -> str:
    """The page: counts, a picture for a sweep of two parameters, and a row for each run of `table`.

    settings: the swept keys; metrics: the columns shown, the first also in the picture; files: what there is beside the page.
    Every run links to its log, its record and, where there is one, its review (`<run id>.html`).
    """
    varied = parameters(table, settings)
    varied.sort(key=lambda key: len({repr(row.get(key)) for row in table}) if isinstance(table[0].get(key), str) else 0)
    # Names are easier to read beside the picture than below it.
    drawn = picture(table, varied[0], varied[1], metrics[0]) if len(varied) == 2 else ""
    shown = ["run", "review", "vehicle", "method", "platform", *[key for key in settings if key not in _SAME], "result"]
    shown += ["violations", "duration_s", *metrics, "reason"]
    counts = Counter(row["result"] for row in table)
    summary = ", ".join(f"{count} {result}" for result, count in counts.most_common())
    heads = "".join(f"<th{_class(name)}>{escape(name)}</th>" for name in shown)
    body = "\n".join(_line(row, shown, files) for row in table)
    return (
        f'<!doctype html><html lang="en"><meta charset="utf-8"><title>{escape(title)}</title>'
        f"<style>{_STYLE}</style><h1>{escape(title)}</h1><p>{len(table)} runs: {escape(summary)}. All figures: "
        '<a href="summary.csv">summary.csv</a>. A click on a head sorts.</p>'
        f"{drawn}<table><thead><tr>{heads}</tr></thead><tbody>\n{body}\n</tbody></table><script>{_SCRIPT}</script></html>\n"
    )


_SAME = ("vehicle.script", "vehicle.aircraft", "cueing.method", "platform.preset")  # have a column of their own already


def _line(row: Row, shown: Sequence[str], files: Collection[str]) -> str:
    bad = "" if row["result"] == "ok" and not row.get("violations") else ' class="bad"'
    return f"<tr{bad}>{''.join(_cell(row, name, files) for name in shown)}</tr>"


def _cell(row: Row, name: str, files: Collection[str]) -> str:
    if name == "review":
        return f'<td class="text" data-v="">{_links(row, files)}</td>'
    value = row.get(name, "")
    return f'<td{_class(name)} data-v="{escape(str(value))}">{escape(_shown(value))}</td>'


def _links(row: Row, files: Collection[str]) -> str:
    named = {"review": f"{row['run']}.html", "log": row.get("log", ""), "record": f"{row['run']}.json"}
    return " ".join(f'<a href="{quote(file)}">{title}</a>' for title, file in named.items() if file in files)


def _class(name: str) -> str:
    return f' class="text {name}"' if name in _TEXTS else ""


def _shown(value: Any) -> str:
    return f"{value:.5g}" if isinstance(value, float) else str(value)
