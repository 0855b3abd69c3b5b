// The language of the page, and its messages. A message is a call of t with an identifier and the English text:
// t('tour.the-shadow', 'The shadow'). locale/LANGUAGE.json has the text of each identifier in another language, with
// {0} and so on for the values that follow. Only the file of the page's own language is loaded. If it cannot be loaded,
// the page is in English.
import * as link from '../base/link.js';

export const languages = { en: 'English', it: 'Italiano', de: 'Deutsch' };

// The first of these languages that the page supports, or English.
const known = wanted =>
  wanted.map(name => name?.slice(0, 2).toLowerCase()).find(name => Object.hasOwn(languages, name)) ?? 'en';

const wanted = known([
  link.get('lang'),
  new URLSearchParams(location.search).get('lang'),
  ...(navigator.languages ?? [navigator.language]),
]);

// All texts that this page needs, in a language other than English. A page may name a smaller file with only its own
// texts. Returns null for English, or if the file cannot be loaded.
async function words(name) {
  if (name === 'en') return null;
  const file = `locale/${document.documentElement.dataset.locale ?? ''}${name}.json`;
  try {
    const answer = await fetch(new URL(`../${file}`, import.meta.url));
    if (!answer.ok) throw new Error(`HTTP ${answer.status}`);
    return await answer.json();
  } catch (error) {
    console.warn(`${file}: ${error.message}; its texts are in English`);
    return null;
  }
}

// Makes the function t of a language.
const speaker =
  locale =>
  (id, english, ...values) => {
    const text = locale?.page[id] ?? english;
    return values.length ? text.replace(/\{(\d)\}/g, (_, i) => values[i]) : text;
  };

export const locale = await words(wanted);
export const lang = locale ? wanted : 'en';
export const t = speaker(locale);

// Returns the function t of any language. Throws an error if the page does not support the language.
const spoken = { [lang]: t };
export async function speak(name) {
  if (!Object.hasOwn(languages, name)) throw new Error(`there is no language ${name}`);
  return (spoken[name] ??= speaker(await words(name)));
}
