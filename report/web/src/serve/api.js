// What the page asks of the program that serves it. The token stands in the page's address.

const token = new URLSearchParams(location.search).get('token') || '';

/// An answer that says what is wrong: {what, file, line, key, value, allowed, nearest}.
export class ProblemError extends Error {
  constructor(problem, status) {
    super(problem.what);
    this.problem = problem;
    this.status = status;
  }
}

async function ask(path, options) {
  let answer;
  try {
    answer = await fetch(path, { ...options, cache: 'no-store', headers: { 'X-Rollrig-Token': token, ...options.headers } });
  } catch {
    throw new ProblemError({ what: 'rollrig serve does not answer: has it been ended?' }, 0);
  }
  const json = await answer.json().catch(() => ({ error: { what: `the answer cannot be read (${answer.status})` } }));
  if (!answer.ok || json.error && !json.state) throw new ProblemError(json.error || { what: `status ${answer.status}` }, answer.status);
  return json;
}

export const get = (path) => ask(path, { method: 'GET' });
export const post = (path, body = {}) => ask(path, { method: 'POST', body: JSON.stringify(body), headers: { 'Content-Type': 'application/json' } });
export const upload = (path, file) => ask(path, { method: 'POST', body: file, headers: { 'Content-Type': 'application/octet-stream' } });

/// The address of a page that was kept.
export const keptAddress = (name) => `/kept/${encodeURIComponent(name)}?token=${token}`;
