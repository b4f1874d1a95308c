// The page reads without this: it sorts tables, and shows under a plot which points a mark is, where nothing hovers.
for (const head of document.querySelectorAll('.points .sort')) {
  head.classList.add('sortable');
  head.tabIndex = 0;
  const sort = () => {
    const body = head.closest('table').tBodies[0];
    const column = head.cellIndex;
    const down = head.getAttribute('aria-sort') === 'ascending';
    for (const other of head.parentNode.children) other.removeAttribute('aria-sort');
    head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
    const rows = Array.from(body.rows);
    const number = row => Number(row.cells[column].dataset.v ?? NaN);
    const name = row => row.querySelector('a').textContent;
    const order = (a, b) => {
      if (column === 0) return name(a).localeCompare(name(b));
      const [x, y] = [number(a), number(b)];
      if (Number.isNaN(x) || Number.isNaN(y)) return (Number.isNaN(x) - Number.isNaN(y)) * (down ? -1 : 1);
      return x === y ? 0 : x > y ? 1 : -1;
    };
    rows.sort((a, b) => down ? order(b, a) : order(a, b));
    body.append(...rows);
  };
  head.addEventListener('click', sort);
  head.addEventListener('keydown', event => { if (event.key === 'Enter') sort(); });
}
for (const mark of document.querySelectorAll('.pareto .mark')) {
  mark.style.cursor = 'pointer';
  mark.addEventListener('click', () => {
    const caption = mark.closest('figure').querySelector('figcaption');
    const lines = mark.querySelector('title').textContent.split('\n');
    const points = mark.dataset.points.split(' ');
    caption.replaceChildren(...points.flatMap((point, index) => {
      const link = document.createElement('a');
      link.href = '#p' + point;
      link.textContent = lines[index];
      return [link, '\n'];
    }), lines.at(-1));
  });
}
// Browsers that do not open what a link leads to.
addEventListener('hashchange', () => {
  const target = document.getElementById(location.hash.slice(1));
  const details = target ? target.closest('details') : null;
  if (details) { details.open = true; target.scrollIntoView(); }
});
