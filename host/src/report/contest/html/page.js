(() => {
  "use strict";
  // Sorting and filtering of tables. Everything can be read without it.
  const collator = new Intl.Collator(undefined, { numeric: true });
  const textOf = (cell) => cell.dataset.value ?? cell.textContent.trim();
  const numberOf = (cell) => Number.parseFloat(textOf(cell).replaceAll(",", ""));

  function compare(a, b, isText, sign) {
    if (isText) {
      return sign * collator.compare(textOf(a), textOf(b));
    }
    const [x, y] = [numberOf(a), numberOf(b)];
    // What has no number comes last in either order.
    if (Number.isNaN(x) || Number.isNaN(y)) {
      return Number.isNaN(x) - Number.isNaN(y);
    }
    return sign * (x - y);
  }

  for (const table of document.querySelectorAll("table.sortable")) {
    const heads = [...table.tHead.rows[0].cells];
    const body = table.tBodies[0];
    heads.forEach((head, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...head.childNodes);
      head.append(button);
      button.addEventListener("click", () => {
        const sign = head.getAttribute("aria-sort") === "ascending" ? -1 : 1;
        heads.forEach((it) => it.removeAttribute("aria-sort"));
        head.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
        const isText = head.classList.contains("name");
        const rows = [...body.rows];
        rows.sort((a, b) => compare(a.cells[column], b.cells[column], isText, sign));
        body.append(...rows);
      });
    });
  }

  for (const table of document.querySelectorAll("table[data-filter]")) {
    const box = document.createElement("div");
    box.className = "filter";
    const label = document.createElement("label");
    label.textContent = table.dataset.filter;
    const input = document.createElement("input");
    input.type = "search";
    input.id = `filter-${table.id}`;
    label.htmlFor = input.id;
    const count = document.createElement("output");
    count.htmlFor = input.id;
    box.append(label, input, count);
    table.closest(".scroll").before(box);
    const rows = [...table.tBodies[0].rows];
    input.addEventListener("input", () => {
      const wanted = input.value.trim().toLowerCase();
      let shown = 0;
      for (const row of rows) {
        row.hidden = !row.querySelector("th").textContent.toLowerCase().includes(wanted);
        shown += row.hidden ? 0 : 1;
      }
      count.textContent = wanted ? `${shown} of ${rows.length}` : "";
    });
  }
})();
