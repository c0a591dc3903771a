// SPDX-License-Identifier: GPL-3.0-or-later
// Formulas in TeX to HTML: node formulas.js KATEX < list, a list of {tex, display}; what KaTeX cannot read is an error.
"use strict";
const katex = require(process.argv[2]);
const formulas = JSON.parse(require("fs").readFileSync(0, "utf8"));
const shown = formulas.map(({tex, display}) => {
  try {
    return katex.renderToString(tex, {displayMode: display, strict: false});
  } catch (error) {
    console.error(`formula ${tex}: ${error.message}`);
    process.exit(1);
  }
});
process.stdout.write(JSON.stringify(shown));
