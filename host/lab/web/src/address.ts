/** The address of the page, kept up to date with what it shows. */

import {element, setText} from './dom.ts';

/** Browsers refuse more than about three changes of the address a second. */
const EVERY_MS = 400;

export class Address {
  private last = -Infinity;
  private waits = false;
  /** The address that the page has written or followed. */
  private known = location.hash;

  /** `hash` returns the hash of the current state. */
  constructor(private readonly hash: () => string | Promise<string>) {
    addEventListener('hashchange', () => (this.known = location.hash));
  }

  /** The state has changed: updates the address at once, or soon after the last update. */
  change(): void {
    if (this.waits) return;
    const wait = this.last + EVERY_MS - performance.now();
    if (wait <= 0) {
      void this.write();
      return;
    }
    this.waits = true;
    setTimeout(() => {
      this.waits = false;
      void this.write();
    }, wait);
  }

  /** Without a new entry in the history. */
  private async write(): Promise<void> {
    this.last = performance.now();
    const hash = this.hash();
    const text = typeof hash === 'string' ? hash : await hash;
    // Another link that was just entered is not followed yet.
    if (text === location.hash || location.hash !== this.known) return;
    try {
      history.replaceState(null, '', text || location.pathname + location.search);
      this.known = location.hash;
    } catch {
      // The browser refuses it for now; a copied link does not depend on the address.
    }
  }
}

/** Shows what is wrong with the link that the page was opened with; "" for nothing. */
export function sayLinkFault(fault: string): void {
  element('link-fault').hidden = fault === '';
  setText('link-fault', fault && `This link could not be read: ${fault}. Something else is shown.`);
}

/** The fault of a link with a part of this name. */
export function unknownPart(name: string): string {
  return `its part \u201c${name.slice(0, 20)}\u201d is unknown to this page`;
}

/** A link to this page with another hash. */
export function linkWith(hash: string): string {
  return location.href.replace(/#.*$/, '') + hash;
}

/** True: the text is in the clipboard. */
export async function copied(link: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(link);
    return true;
  } catch {
    return false;
  }
}
