// The elements of the page, python/kempe/draw/assets/player.html.

/** The element with an id, which the page must contain. */
export function byId<Kind extends HTMLElement = HTMLElement>(id: string): Kind {
  return document.getElementById(id) as Kind;
}
