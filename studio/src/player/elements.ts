// The elements of the page, python/kempe/draw/assets/player.html.

/** The element of an id that the page has. */
export function byId<Kind extends HTMLElement = HTMLElement>(id: string): Kind {
  return document.getElementById(id) as Kind;
}
