// The page as it is printed: light, with the styles of the class 'paper', its tables and charts fitted to the sheets.
import { drawAll } from './chart.js';
import { fillSheets, restoreSheets } from './paper_flow.js';
import { fitTables, restoreTables } from './paper_tables.js';
import { setOnPaper } from './theme.js';

/// A fold of JSON is for programs: it stays off paper.
const listFolds = () => [...document.querySelectorAll('details.fold')].filter((fold) => !fold.querySelector('pre'));

export function preparePrinting() {
  addEventListener('beforeprint', () => {
    listFolds().forEach((fold) => (fold.open = true));
    setOnPaper(true);
    document.documentElement.classList.add('paper');
    drawAll();
    fitTables();
    fillSheets();
  });
  addEventListener('afterprint', () => {
    restoreTables();
    restoreSheets();
    document.documentElement.classList.remove('paper');
    setOnPaper(false);
    drawAll();
  });
}
