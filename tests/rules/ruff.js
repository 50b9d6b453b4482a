// Runs ruff, compiled to WebAssembly, under node: {"options", "files": {path: text}} in, ["path:row:column code message"] out.
const fs = require("fs");
const path = require("path");

const { Workspace, PositionEncoding } = require(path.join(process.argv[2], "@astral-sh/ruff-wasm-nodejs"));
const { options, files } = JSON.parse(fs.readFileSync(0, "utf8"));
const workspace = new Workspace(options, PositionEncoding.Utf32);
const complaints = [];
for (const [name, text] of Object.entries(files)) {
  for (const found of workspace.check(text)) {
    const { row, column } = found.start_location;
    complaints.push(`${name}:${row}:${column} ${found.code} ${found.message}`);
  }
}
console.log(JSON.stringify(complaints));
