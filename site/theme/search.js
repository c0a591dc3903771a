// SPDX-License-Identifier: GPL-3.0-or-later
// Search in the site's index (index.js): parts of pages that have all the words, those with one in the title first.
"use strict";
(() => {
  const field = document.getElementById("search"), found = document.getElementById("found");
  const article = document.querySelector("article"), most = 30, around = 80;

  function search(words) {
    const hits = [], seen = new Set(); // a page is in the index as a whole and by its parts
    for (const [place, title, text] of window.sheetIndex) {
      const head = title.toLowerCase(), body = text.toLowerCase();
      const name = place.split("#")[0] + title;
      if (seen.has(name) || !words.every(word => head.includes(word) || body.includes(word)))
        continue;
      seen.add(name);
      const rank = words.filter(word => head.includes(word)).length;
      const at = Math.max(0, body.indexOf(words.find(word => body.includes(word)) ?? ""));
      hits.push({place, title, rank, text: text.slice(Math.max(0, at - around), at + 2 * around)});
    }
    return hits.sort((a, b) => b.rank - a.rank).slice(0, most);
  }

  function show() {
    const words = field.value.toLowerCase().split(/\s+/).filter(word => word.length > 1);
    found.hidden = words.length === 0;
    article.hidden = words.length > 0;
    found.replaceChildren();
    if (words.length === 0)
      return;
    const hits = search(words), heading = document.createElement("h1");
    heading.textContent = hits.length ? `${hits.length}${hits.length === most ? " or more" : ""} found` : "Nothing found";
    found.append(heading);
    for (const hit of hits) {
      const entry = document.createElement("p"), link = document.createElement("a");
      link.href = `${field.dataset.root}/${hit.place}`;
      link.textContent = hit.title;
      link.addEventListener("click", () => { field.value = ""; show(); });
      entry.append(link, document.createElement("br"), `... ${hit.text} ...`);
      found.append(entry);
    }
  }
  field.addEventListener("input", show);
  field.value = new URLSearchParams(location.search).get("q") ?? ""; // a link to a search: index.html?q=words
  show();
})();
