// Finds patterns by their names, codes and everyday words in all languages.

/** The patterns that fit all words of a text, the best first.
 * @param {string} text @param {{ name: string, title: string, words: string }[]} patterns */
export function foundPatterns(text, patterns) {
  const wanted = text.toLowerCase().replaceAll("_", " ").split(/[\s/]+/).filter(Boolean);
  if (!wanted.length) return patterns.map(({ name }) => name);
  const ranked = patterns.map((pattern) => ({ name: pattern.name, rank: Math.max(...wanted.map((word) => rankOf(word, pattern))) }));
  return ranked.filter(({ rank }) => rank < UNLIKE).sort((a, b) => a.rank - b.rank).map(({ name }) => name);
}

const UNLIKE = 9;

/** How well a pattern fits a word: 0 is the best.
 * @param {string} word @param {{ title: string, words: string }} pattern */
function rankOf(word, { title, words }) {
  const all = ` ${title.toLowerCase()} ${words} `;
  if (all.includes(` ${word} `)) return title.toLowerCase().includes(word) ? 0 : 1;
  if (all.includes(` ${word}`)) return 2;
  return all.includes(word) ? 3 : UNLIKE;
}
