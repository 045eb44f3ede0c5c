// Tables: sorted by a click on a heading, copied as CSV in the order that they stand in. Each row carries its CSV.

// The fields of one CSV record (RFC 4180).
function csvFields(record) {
  const fields = [];
  const field = /("(?:[^"]|"")*"|[^,]*)(,|$)/g;
  for (;;) {
    const [, text, end] = field.exec(record);
    fields.push(text.startsWith('"') ? text.slice(1, -1).replaceAll('""', '"') : text);
    if (end === '') return fields;
  }
}

const isNumber = (text) => text !== '' && Number.isFinite(Number(text));

// Empty cells come last either way.
function compareFields(a, b, numeric, sign) {
  if (a === '' || b === '') return (a === '' ? 1 : 0) - (b === '' ? 1 : 0);
  return sign * (numeric ? Number(a) - Number(b) : a.localeCompare(b, 'en', { numeric: true }));
}

// Numbers first fall, texts first rise; the same heading again turns the order round.
function sortTable(table, column) {
  const heading = table.tHead.rows[0].cells[column];
  const body = table.tBodies[0];
  const rows = [...body.rows].map((row) => ({ row, field: csvFields(row.dataset.csv)[column] }));
  const filled = rows.filter(({ field }) => field !== '');
  const numeric = filled.length > 0 && filled.every(({ field }) => isNumber(field));
  const before = heading.getAttribute('aria-sort');
  const rising = before ? before === 'descending' : !numeric;
  for (const other of table.tHead.rows[0].cells) other.removeAttribute('aria-sort');
  heading.setAttribute('aria-sort', rising ? 'ascending' : 'descending');
  rows.sort((a, b) => compareFields(a.field, b.field, numeric, rising ? 1 : -1));
  body.append(...rows.map(({ row }) => row));
}

function makeSortable(table) {
  for (const heading of table.tHead.rows[0].cells) {
    const button = document.createElement('button');
    button.type = 'button';
    button.title = 'Sort';
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener('click', () => sortTable(table, heading.cellIndex));
  }
}

// The older way serves browsers that keep the clipboard from local files.
async function copyText(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = document.createElement('textarea');
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand('copy');
    area.remove();
    return done;
  }
}

function makeCopyable(button, table) {
  button.hidden = false;
  button.addEventListener('click', async () => {
    const csv = [...table.rows].map((row) => `${row.dataset.csv}\r\n`).join('');
    const before = button.textContent;
    button.textContent = (await copyText(csv)) ? 'Copied' : 'Could not copy';
    setTimeout(() => { button.textContent = before; }, 1500);
  });
}

for (const figure of document.querySelectorAll('figure.table')) {
  const table = figure.querySelector('table');
  makeSortable(table);
  makeCopyable(figure.querySelector('button.copy'), table);
}
