// Files of a folder that is dropped on the page, or chosen.

/// All entries of a folder: a browser hands them out in parts.
async function readAll(folder) {
  const reader = folder.createReader();
  const entries = [];
  for (;;) {
    const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
    if (!some.length) return entries;
    entries.push(...some);
  }
}

async function collect(entry, path, files) {
  if (entry.isFile) {
    const file = await new Promise((resolve, reject) => entry.file(resolve, reject));
    files.push({ name: path + entry.name, file });
  } else if (entry.isDirectory) {
    for (const inner of await readAll(entry)) await collect(inner, `${path}${entry.name}/`, files);
  }
}

/// {name, files: [{name, file}]}: names below the folder. What is dropped beside each other counts as one folder.
async function readDropped(transfer) {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry && item.webkitGetAsEntry()).filter(Boolean);
  const files = [];
  if (!entries.length) [...transfer.files].forEach((file) => files.push({ name: file.name, file }));
  for (const entry of entries) await collect(entry, '', files);
  return asFolder(files);
}

/// The one folder that holds all files is the set's; its name is not part of theirs.
function asFolder(files) {
  const tops = new Set(files.map(({ name }) => (name.includes('/') ? name.slice(0, name.indexOf('/')) : '')));
  const [top] = tops;
  if (tops.size !== 1 || !top) return { name: '', files };
  return { name: top, files: files.map(({ name, file }) => ({ name: name.slice(top.length + 1), file })) };
}

export const readChosen = (list) => asFolder([...list].map((file) => ({ name: file.webkitRelativePath || file.name, file })));

/// Calls `take` with what is dropped anywhere on the page.
export function listenForDrops(take) {
  let depth = 0;
  const show = (isOver) => document.body.classList.toggle('over', isOver);
  const holdsFiles = (event) => event.dataTransfer && [...event.dataTransfer.types].includes('Files');
  addEventListener('dragenter', (event) => holdsFiles(event) && (event.preventDefault(), show(++depth > 0)));
  addEventListener('dragleave', (event) => holdsFiles(event) && show((depth = Math.max(0, depth - 1)) > 0));
  addEventListener('dragover', (event) => holdsFiles(event) && event.preventDefault());
  addEventListener('drop', (event) => {
    if (!holdsFiles(event)) return;
    event.preventDefault();
    show((depth = 0) > 0);
    readDropped(event.dataTransfer).then(take);
  });
}
