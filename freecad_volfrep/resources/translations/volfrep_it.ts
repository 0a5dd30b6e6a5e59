<?xml version="1.0" encoding="utf-8"?>
<!-- SPDX-License-Identifier: LGPL-2.1-or-later -->
<!DOCTYPE TS>
<TS version="2.1" language="it" sourcelanguage="en">
  <context>
    <name>App::Property</name>
    <message>
      <source>1 Lattice</source>
      <translation>1 Reticolo</translation>
    </message>
    <message>
      <source>2 Skin</source>
      <translation>2 Guscio</translation>
    </message>
    <message>
      <source>2 to 8; empty ones are left out</source>
      <translation>Da 2 a 8; quelle vuote si omettono</translation>
    </message>
    <message>
      <source>3 Grading</source>
      <translation>3 Gradazione</translation>
    </message>
    <message>
      <source>4 Print</source>
      <translation>4 Stampa</translation>
    </message>
    <message>
      <source>5 Result</source>
      <translation>5 Risultato</translation>
    </message>
    <message>
      <source>6 Advanced</source>
      <translation>6 Avanzate</translation>
    </message>
    <message>
      <source>A field that the density of the points follows in place of the depth: s is 0 at its smallest value and 1 at its largest (files as of a radius field, of one column)</source>
      <translation>Un campo che la densità dei punti segue al posto della profondità: s è 0 al suo valore minimo e 1 al massimo (file come per un campo del raggio, con una colonna)</translation>
    </message>
    <message>
      <source>A point of the axis, or the centre</source>
      <translation>Un punto dell'asse, o il centro</translation>
    </message>
    <message>
      <source>A point that is to be a corner of a cell; of a network of a file, where its own origin is to lie</source>
      <translation>Un punto che deve essere un vertice di una cella; di una rete da un file: dove deve trovarsi la sua origine</translation>
    </message>
    <message>
      <source>Activation</source>
      <translation>Attivazione</translation>
    </message>
    <message>
      <source>All figures of the last update, as JSON</source>
      <translation>Tutti i dati dell'ultimo aggiornamento, in JSON</translation>
    </message>
    <message>
      <source>All figures, as JSON</source>
      <translation>Tutti i dati, in JSON</translation>
    </message>
    <message>
      <source>All figures, for people</source>
      <translation>Tutti i dati, da leggere</translation>
    </message>
    <message>
      <source>Along this direction of the cell: 1,0,0 along its edges, 1,1,0 across its faces, 1,1,1 along its diagonals</source>
      <translation>Lungo questa direzione della cella: 1,0,0 lungo gli spigoli, 1,1,0 attraverso le facce, 1,1,1 lungo le diagonali</translation>
    </message>
    <message>
      <source>Along which the density changes, in the document's coordinates</source>
      <translation>Lungo la quale la densità cambia, nelle coordinate del documento</translation>
    </message>
    <message>
      <source>Another seed draws other points</source>
      <translation>Un altro seme estrae altri punti</translation>
    </message>
    <message>
      <source>Auto Update</source>
      <translation>Aggiornamento automatico</translation>
    </message>
    <message>
      <source>Axis that the cells lie about</source>
      <translation>Asse attorno al quale stanno le celle</translation>
    </message>
    <message>
      <source>Band Densities</source>
      <translation>Densità delle bande</translation>
    </message>
    <message>
      <source>Band Volumes</source>
      <translation>Volumi delle bande</translation>
    </message>
    <message>
      <source>Bands</source>
      <translation>Bande</translation>
    </message>
    <message>
      <source>Base</source>
      <translation>Base</translation>
    </message>
    <message>
      <source>Between struts that do not meet, mm</source>
      <translation>Tra aste che non si incontrano, mm</translation>
    </message>
    <message>
      <source>Bodies</source>
      <translation>Corpi</translation>
    </message>
    <message>
      <source>Bottom Layers</source>
      <translation>Strati inferiori</translation>
    </message>
    <message>
      <source>Boundary</source>
      <translation>Bordo</translation>
    </message>
    <message>
      <source>Build Direction</source>
      <translation>Direzione di stampa</translation>
    </message>
    <message>
      <source>By how many mm a skeleton or complement is thicker than up to the surface; negative for a thinner one</source>
      <translation>Di quanti mm uno scheletro o il suo complemento supera la superficie; negativo per uno più sottile</translation>
    </message>
    <message>
      <source>CSV or VTK file of points and values</source>
      <translation>File CSV o VTK di punti e valori</translation>
    </message>
    <message>
      <source>Cartesian</source>
      <translation>Cartesiana</translation>
    </message>
    <message>
      <source>Cell Edges</source>
      <translation>Spigoli delle celle</translation>
    </message>
    <message>
      <source>Cell File</source>
      <translation>File della cella</translation>
    </message>
    <message>
      <source>Cell Map</source>
      <translation>Disposizione delle celle</translation>
    </message>
    <message>
      <source>Cell Size</source>
      <translation>Dimensione cella</translation>
    </message>
    <message>
      <source>Cell Type</source>
      <translation>Tipo di cella</translation>
    </message>
    <message>
      <source>Cell Values</source>
      <translation>Valori della cella</translation>
    </message>
    <message>
      <source>Cell map</source>
      <translation>Disposizione delle celle</translation>
    </message>
    <message>
      <source>Cell size</source>
      <translation>Dimensione cella</translation>
    </message>
    <message>
      <source>Cells</source>
      <translation>Celle</translation>
    </message>
    <message>
      <source>Cells Active</source>
      <translation>Celle attive</translation>
    </message>
    <message>
      <source>Cells Total</source>
      <translation>Celle totali</translation>
    </message>
    <message>
      <source>Cells along straight axes, about an axis, or about a centre</source>
      <translation>Celle lungo assi rettilinei, attorno a un asse o attorno a un centro</translation>
    </message>
    <message>
      <source>Cells around the full turn; 0 for as many as make them L wide half-way out</source>
      <translation>Celle sull'intero giro; 0 per averne quante servono a renderle larghe L a metà raggio</translation>
    </message>
    <message>
      <source>Cells grow along it</source>
      <translation>Le celle crescono lungo di essa</translation>
    </message>
    <message>
      <source>Cells in the grid</source>
      <translation>Celle della griglia</translation>
    </message>
    <message>
      <source>Cells that grow along a direction: the profile of lambda (section 2.5 of the method)</source>
      <translation>Celle che crescono lungo una direzione: il profilo di lambda (sezione 2.5 del metodo)</translation>
    </message>
    <message>
      <source>Cells that hold a lattice</source>
      <translation>Celle che contengono il reticolo</translation>
    </message>
    <message>
      <source>Centre</source>
      <translation>Centro</translation>
    </message>
    <message>
      <source>Closed cavities</source>
      <translation>Cavità chiuse</translation>
    </message>
    <message>
      <source>Closed voids, which would trap powder or resin</source>
      <translation>Vuoti chiusi, che tratterrebbero polvere o resina</translation>
    </message>
    <message>
      <source>Colour of the lattice inside the skin</source>
      <translation>Colore del reticolo dentro il guscio</translation>
    </message>
    <message>
      <source>Complement</source>
      <translation>Complemento</translation>
    </message>
    <message>
      <source>Compute at every change; switch it off for large jobs and use Update Lattice Infill</source>
      <translation>Calcola a ogni modifica; da disattivare per lavori grandi, usando Aggiorna riempimento reticolare</translation>
    </message>
    <message>
      <source>Computing time of the last update</source>
      <translation>Tempo di calcolo dell'ultimo aggiornamento</translation>
    </message>
    <message>
      <source>Core</source>
      <translation>Nucleo</translation>
    </message>
    <message>
      <source>Curve</source>
      <translation>Curva</translation>
    </message>
    <message>
      <source>Custom</source>
      <translation>Personalizzata</translation>
    </message>
    <message>
      <source>Cylindrical</source>
      <translation>Cilindrica</translation>
    </message>
    <message>
      <source>Dangling Removed</source>
      <translation>Aste pendenti rimosse</translation>
    </message>
    <message>
      <source>Delaunay</source>
      <translation>Delaunay</translation>
    </message>
    <message>
      <source>Density</source>
      <translation>Densità</translation>
    </message>
    <message>
      <source>Density End</source>
      <translation>Densità finale</translation>
    </message>
    <message>
      <source>Density Start</source>
      <translation>Densità iniziale</translation>
    </message>
    <message>
      <source>Density of the material in g/cm3</source>
      <translation>Densità del materiale in g/cm3</translation>
    </message>
    <message>
      <source>Density of the points as a formula of s, 0 at the wall and 1 at the deepest place, such as '3 - 2 * s'; empty for an even one</source>
      <translation>Densità dei punti come formula di s, 0 alla parete e 1 nel punto più profondo, come '3 - 2 * s'; vuota se uniforme</translation>
    </message>
    <message>
      <source>Depth at which the grading ends, for the grading over the depth</source>
      <translation>Profondità a cui finisce la gradazione, per la gradazione in profondità</translation>
    </message>
    <message>
      <source>Depth at which the profile ends</source>
      <translation>Profondità alla quale il profilo finisce</translation>
    </message>
    <message>
      <source>Designs</source>
      <translation>Progetti</translation>
    </message>
    <message>
      <source>Designs and their figures, as JSON</source>
      <translation>Progetti e i loro valori, come JSON</translation>
    </message>
    <message>
      <source>Designs with figures</source>
      <translation>Progetti con valori</translation>
    </message>
    <message>
      <source>Deviation</source>
      <translation>Scostamento</translation>
    </message>
    <message>
      <source>Diameter of the holes that let powder or resin out of the skin; 0 for none</source>
      <translation>Diametro dei fori che fanno uscire polvere o resina dal guscio; 0 per nessuno</translation>
    </message>
    <message>
      <source>Direction</source>
      <translation>Direzione</translation>
    </message>
    <message>
      <source>Distance from the faces of KeepSolidAround up to which the part stays solid</source>
      <translation>Distanza dalle facce di KeepSolidAround fino alla quale il pezzo resta pieno</translation>
    </message>
    <message>
      <source>Domain</source>
      <translation>Dominio</translation>
    </message>
    <message>
      <source>Drain Count</source>
      <translation>Numero di fori</translation>
    </message>
    <message>
      <source>Drain Diameter</source>
      <translation>Diametro dei fori</translation>
    </message>
    <message>
      <source>Drain Faces</source>
      <translation>Facce forate</translation>
    </message>
    <message>
      <source>Drain Holes</source>
      <translation>Fori di scarico</translation>
    </message>
    <message>
      <source>Drain Points</source>
      <translation>Punti dei fori</translation>
    </message>
    <message>
      <source>Even Density</source>
      <translation>Densità uniforme</translation>
    </message>
    <message>
      <source>Every edge is shared by exactly two triangles</source>
      <translation>Ogni spigolo appartiene a due triangoli esatti</translation>
    </message>
    <message>
      <source>Expected</source>
      <translation>Previsione</translation>
    </message>
    <message>
      <source>Exponential</source>
      <translation>Esponenziale</translation>
    </message>
    <message>
      <source>FEM result, or lattice infill that was sized for loads</source>
      <translation>Risultato FEM, o riempimento reticolare dimensionato per carichi</translation>
    </message>
    <message>
      <source>Faces</source>
      <translation>Facce</translation>
    </message>
    <message>
      <source>Faces in the middle of which holes are drilled</source>
      <translation>Facce nel cui centro si praticano i fori</translation>
    </message>
    <message>
      <source>Faces of the solid that have no skin: the cavity opens there, struts are cut flush</source>
      <translation>Facce del solido senza guscio: lì la cavità si apre e le aste sono tagliate a filo</translation>
    </message>
    <message>
      <source>Faces of the solid whose skin has a thickness of its own, each with its number in SkinThicknesses</source>
      <translation>Facce del solido il cui guscio ha uno spessore proprio, ognuna con il suo numero in SkinThicknesses</translation>
    </message>
    <message>
      <source>Faces round which the part stays solid, up to KeepDistance, and solids whose room in it does</source>
      <translation>Facce attorno alle quali il pezzo resta pieno, fino a KeepDistance, e solidi il cui spazio in esso resta pieno</translation>
    </message>
    <message>
      <source>Facets</source>
      <translation>Facce</translation>
    </message>
    <message>
      <source>Facets along the edge of a cell; 0 to choose it by the deviation</source>
      <translation>Faccette lungo lo spigolo di una cella; 0 per sceglierle con lo scostamento</translation>
    </message>
    <message>
      <source>Field</source>
      <translation>Campo</translation>
    </message>
    <message>
      <source>Field Column</source>
      <translation>Colonna del campo</translation>
    </message>
    <message>
      <source>Field File</source>
      <translation>File del campo</translation>
    </message>
    <message>
      <source>Field Object</source>
      <translation>Oggetto del campo</translation>
    </message>
    <message>
      <source>Filament</source>
      <translation>Filamento</translation>
    </message>
    <message>
      <source>Filament Volume</source>
      <translation>Volume del filamento</translation>
    </message>
    <message>
      <source>File</source>
      <translation>File</translation>
    </message>
    <message>
      <source>File of points and thicknesses of the skin, which it follows below all other faces, nowhere thinner than the shell</source>
      <translation>File di punti e spessori del guscio, che esso segue sotto tutte le altre facce, mai più sottile dello spessore del guscio</translation>
    </message>
    <message>
      <source>File of points and values: .csv, .txt, .vtu, .vtk</source>
      <translation>File di punti e valori: .csv, .txt, .vtu, .vtk</translation>
    </message>
    <message>
      <source>Fill</source>
      <translation>Riempi</translation>
    </message>
    <message>
      <source>Findings</source>
      <translation>Rilievi</translation>
    </message>
    <message>
      <source>Folder</source>
      <translation>Cartella</translation>
    </message>
    <message>
      <source>Follows</source>
      <translation>Segue</translation>
    </message>
    <message>
      <source>For which the project is written</source>
      <translation>Per cui si scrive il progetto</translation>
    </message>
    <message>
      <source>Formula</source>
      <translation>Formula</translation>
    </message>
    <message>
      <source>From the build plate up</source>
      <translation>Dal piano di stampa verso l'alto</translation>
    </message>
    <message>
      <source>From the build plate up, in the document's coordinates</source>
      <translation>Dal piano di stampa verso l'alto, nelle coordinate del documento</translation>
    </message>
    <message>
      <source>Genus</source>
      <translation>Genere</translation>
    </message>
    <message>
      <source>Grading Direction</source>
      <translation>Direzione della gradazione</translation>
    </message>
    <message>
      <source>Holes for each void that is still closed, at its lowest places along the build direction</source>
      <translation>Fori per ogni vuoto ancora chiuso, nei suoi punti più bassi lungo la direzione di stampa</translation>
    </message>
    <message>
      <source>How it will be printed</source>
      <translation>Come sarà stampato</translation>
    </message>
    <message>
      <source>How many layers of cells lie upon a surface or between two; 0 for as many as come nearest to the cell size</source>
      <translation>Quanti strati di celle stanno su una superficie o tra due; 0 per quanti si avvicinano di più alla dimensione della cella</translation>
    </message>
    <message>
      <source>How many points lie in the part; 0 for as many as lie a cell size apart</source>
      <translation>Quanti punti stanno nel pezzo; 0 per quanti distano una cella</translation>
    </message>
    <message>
      <source>How often each point moves to the middle of its cell, which evens them out</source>
      <translation>Quante volte ogni punto va al centro della sua cella, il che li rende più uniformi</translation>
    </message>
    <message>
      <source>How the part is printed: its limits are those of the print check</source>
      <translation>Come si stampa il pezzo: i limiti del processo sono quelli del controllo di stampa</translation>
    </message>
    <message>
      <source>Infill</source>
      <translation>Riempimento</translation>
    </message>
    <message>
      <source>Inside</source>
      <translation>Dentro</translation>
    </message>
    <message>
      <source>Internal</source>
      <translation>Interno</translation>
    </message>
    <message>
      <source>Its density gives the mass</source>
      <translation>La sua densità dà la massa</translation>
    </message>
    <message>
      <source>Joint Fillet</source>
      <translation>Raccordo dei nodi</translation>
    </message>
    <message>
      <source>Keep Distance</source>
      <translation>Distanza piena</translation>
    </message>
    <message>
      <source>Keep Pieces</source>
      <translation>Mantieni pezzi staccati</translation>
    </message>
    <message>
      <source>Keep Radius</source>
      <translation>Mantieni raggio</translation>
    </message>
    <message>
      <source>Keep Solid Around</source>
      <translation>Lascia pieno attorno a</translation>
    </message>
    <message>
      <source>Keep pieces of the lattice that hang on nothing; otherwise they are left out, and told</source>
      <translation>Mantiene i pezzi del reticolo che non sono attaccati a nulla; altrimenti vengono tolti e segnalati</translation>
    </message>
    <message>
      <source>L: edge length of the cubic cell</source>
      <translation>L: lunghezza dello spigolo della cella cubica</translation>
    </message>
    <message>
      <source>Lambda End</source>
      <translation>Lambda alla fine</translation>
    </message>
    <message>
      <source>Lambda Formula</source>
      <translation>Formula di lambda</translation>
    </message>
    <message>
      <source>Lambda Start</source>
      <translation>Lambda all'inizio</translation>
    </message>
    <message>
      <source>Largest Ball</source>
      <translation>Sfera più grande</translation>
    </message>
    <message>
      <source>Largest distance between a facet and the exact struts and joints, kept within 1.5 times; 0 for a thirty-fifth of the radius</source>
      <translation>Distanza massima tra una faccetta e le aste e i giunti esatti, rispettata entro 1,5 volte; 0 per un trentacinquesimo del raggio</translation>
    </message>
    <message>
      <source>Lattice</source>
      <translation>Reticolo</translation>
    </message>
    <message>
      <source>Layer Height</source>
      <translation>Altezza dello strato</translation>
    </message>
    <message>
      <source>Layers upon one surface lie on its other side, against its normals</source>
      <translation>Gli strati su una superficie stanno dall'altra parte, contro le sue normali</translation>
    </message>
    <message>
      <source>Least thickness of walls, mm</source>
      <translation>Spessore minimo delle pareti, mm</translation>
    </message>
    <message>
      <source>Length of the longest strut of these</source>
      <translation>Lunghezza della più lunga di queste aste</translation>
    </message>
    <message>
      <source>Limits</source>
      <translation>Limiti</translation>
    </message>
    <message>
      <source>Line Width</source>
      <translation>Larghezza della linea</translation>
    </message>
    <message>
      <source>Linear</source>
      <translation>Lineare</translation>
    </message>
    <message>
      <source>Lines side by side</source>
      <translation>Linee affiancate</translation>
    </message>
    <message>
      <source>Longest Overhang</source>
      <translation>Sbalzo più lungo</translation>
    </message>
    <message>
      <source>Loose fragments that were dropped</source>
      <translation>Frammenti isolati eliminati</translation>
    </message>
    <message>
      <source>Make and measure every design, too</source>
      <translation>Crea e misura anche ogni progetto</translation>
    </message>
    <message>
      <source>Map Around</source>
      <translation>Celle sul giro</translation>
    </message>
    <message>
      <source>Map Axis</source>
      <translation>Asse della disposizione</translation>
    </message>
    <message>
      <source>Map Centre</source>
      <translation>Centro della disposizione</translation>
    </message>
    <message>
      <source>Mass</source>
      <translation>Massa</translation>
    </message>
    <message>
      <source>Mass in g at the given density</source>
      <translation>Massa in g alla densità indicata</translation>
    </message>
    <message>
      <source>Mass of the finished part, with its skin</source>
      <translation>Massa del pezzo finito, con il suo guscio</translation>
    </message>
    <message>
      <source>Material</source>
      <translation>Materiale</translation>
    </message>
    <message>
      <source>Material File</source>
      <translation>File del materiale</translation>
    </message>
    <message>
      <source>Material Price</source>
      <translation>Prezzo del materiale</translation>
    </message>
    <message>
      <source>Mean of the field in each band, percent</source>
      <translation>Media del campo in ogni banda, percento</translation>
    </message>
    <message>
      <source>Mesh</source>
      <translation>Mesh</translation>
    </message>
    <message>
      <source>Narrowest Gap</source>
      <translation>Luce minima</translation>
    </message>
    <message>
      <source>Network</source>
      <translation>Rete</translation>
    </message>
    <message>
      <source>Network Angle</source>
      <translation>Rete: angolo</translation>
    </message>
    <message>
      <source>Network Density</source>
      <translation>Rete: densità</translation>
    </message>
    <message>
      <source>Network Faces</source>
      <translation>Facce della rete</translation>
    </message>
    <message>
      <source>Network Field</source>
      <translation>Campo della rete</translation>
    </message>
    <message>
      <source>Network File</source>
      <translation>Rete: file</translation>
    </message>
    <message>
      <source>Network Layers</source>
      <translation>Strati della rete</translation>
    </message>
    <message>
      <source>Network On Wall</source>
      <translation>Rete sulla parete</translation>
    </message>
    <message>
      <source>Network Points</source>
      <translation>Rete: punti</translation>
    </message>
    <message>
      <source>Network Relax</source>
      <translation>Rete: rilassamento</translation>
    </message>
    <message>
      <source>Network Reversed</source>
      <translation>Rete invertita</translation>
    </message>
    <message>
      <source>Network Seed</source>
      <translation>Rete: seme</translation>
    </message>
    <message>
      <source>Network Shortest</source>
      <translation>Rete: asta minima</translation>
    </message>
    <message>
      <source>Network Thickness</source>
      <translation>Spessore della rete</translation>
    </message>
    <message>
      <source>Nodes</source>
      <translation>Nodi</translation>
    </message>
    <message>
      <source>Nodes and struts: .json, .csv, lines of .obj or .vtk, beams of .3mf; or a mesh (.vtk, .vtu, .inp, .msh, .obj) whose hexahedra the cell is laid into, on whose quadrilaterals layers of it lie, or whose tetrahedra's edges are struts</source>
      <translation>Nodi e aste: .json, .csv, linee di .obj o .vtk, travi di .3mf; oppure una mesh (.vtk, .vtu, .inp, .msh, .obj) nei cui esaedri si pone la cella, sui cui quadrilateri sta a strati o i cui spigoli dei tetraedri sono aste</translation>
    </message>
    <message>
      <source>Nodes of the lattice before trimming</source>
      <translation>Nodi del reticolo prima del taglio</translation>
    </message>
    <message>
      <source>None</source>
      <translation>Nessuno</translation>
    </message>
    <message>
      <source>Numbers that the cell leaves to be chosen, such as 'arm = 0.15' of Re-entrant; 'volfrep cells' tells which</source>
      <translation>Numeri che la cella lascia scegliere, come 'arm = 0.15' di Re-entrant; 'volfrep cells' dice quali</translation>
    </message>
    <message>
      <source>Of a layer</source>
      <translation>Di uno strato</translation>
    </message>
    <message>
      <source>Of all that is extruded</source>
      <translation>Di tutto ciò che viene estruso</translation>
    </message>
    <message>
      <source>Of an extruded line</source>
      <translation>Di una linea estrusa</translation>
    </message>
    <message>
      <source>Of the facets that hang over: this object's mesh</source>
      <translation>Delle faccette a sbalzo: la mesh di questo oggetto</translation>
    </message>
    <message>
      <source>Of the filament, g</source>
      <translation>Del filamento, g</translation>
    </message>
    <message>
      <source>Of the layers of cells upon one surface together</source>
      <translation>Di tutti gli strati di celle su una superficie</translation>
    </message>
    <message>
      <source>Of the mesh: the solid's, then each band's</source>
      <translation>Della mesh: quelle del solido, poi di ogni banda</translation>
    </message>
    <message>
      <source>Of the part</source>
      <translation>Della parte</translation>
    </message>
    <message>
      <source>Of the part, g</source>
      <translation>Della parte, g</translation>
    </message>
    <message>
      <source>Of the process, and their source</source>
      <translation>Del processo, con la loro fonte</translation>
    </message>
    <message>
      <source>Of the solid</source>
      <translation>Del solido</translation>
    </message>
    <message>
      <source>Of the struts' length, too flat</source>
      <translation>Della lunghezza delle aste, troppo piatta</translation>
    </message>
    <message>
      <source>Of two struts that meet at less than so many degrees the longer one goes</source>
      <translation>Di due aste che si incontrano a meno di tanti gradi la più lunga viene tolta</translation>
    </message>
    <message>
      <source>Of walls and solid layers</source>
      <translation>Di pareti e strati pieni</translation>
    </message>
    <message>
      <source>Open Faces</source>
      <translation>Facce aperte</translation>
    </message>
    <message>
      <source>Openings</source>
      <translation>Aperture</translation>
    </message>
    <message>
      <source>Orientation</source>
      <translation>Orientamento</translation>
    </message>
    <message>
      <source>Origin</source>
      <translation>Origine</translation>
    </message>
    <message>
      <source>Output</source>
      <translation>Risultato</translation>
    </message>
    <message>
      <source>Overhang Area</source>
      <translation>Area a sbalzo</translation>
    </message>
    <message>
      <source>Overhang Share</source>
      <translation>Quota a sbalzo</translation>
    </message>
    <message>
      <source>Part</source>
      <translation>Parte</translation>
    </message>
    <message>
      <source>Pattern</source>
      <translation>Motivo</translation>
    </message>
    <message>
      <source>Percent at the end: at the skin, or where the field is largest</source>
      <translation>Percento alla fine: al guscio, o dove il campo è massimo</translation>
    </message>
    <message>
      <source>Percent at the start: deep inside, or where the field is smallest</source>
      <translation>Percento all'inizio: in profondità, o dove il campo è minimo</translation>
    </message>
    <message>
      <source>Percent of x, y and z in mm, such as 10 + z</source>
      <translation>Percento da x, y e z in mm, come 10 + z</translation>
    </message>
    <message>
      <source>Pieces Removed</source>
      <translation>Pezzi rimossi</translation>
    </message>
    <message>
      <source>Points where holes are drilled</source>
      <translation>Punti in cui si praticano i fori</translation>
    </message>
    <message>
      <source>Price of a kilogram of the material in your currency, for the cost in the panel; 0 for not known</source>
      <translation>Prezzo di un chilogrammo del materiale nella propria valuta, per il costo nel pannello; 0 se non è noto</translation>
    </message>
    <message>
      <source>Print</source>
      <translation>Stampa</translation>
    </message>
    <message>
      <source>Print Material</source>
      <translation>Materiale di stampa</translation>
    </message>
    <message>
      <source>Print Process</source>
      <translation>Processo di stampa</translation>
    </message>
    <message>
      <source>Process</source>
      <translation>Processo</translation>
    </message>
    <message>
      <source>Profile of the radius over s</source>
      <translation>Profilo del raggio in funzione di s</translation>
    </message>
    <message>
      <source>Properties and their values: 'CellSize: 6, 8, 10' or 'ShellThickness: 1 to 3 in 5'</source>
      <translation>Proprietà e i loro valori: 'CellSize: 6, 8, 10' oppure 'ShellThickness: 1 to 3 in 5'</translation>
    </message>
    <message>
      <source>Put a corner of a cell at Origin; otherwise the cells start at the corner of the solid</source>
      <translation>Mette un vertice di una cella in Origin; altrimenti le celle partono dallo spigolo del solido</translation>
    </message>
    <message>
      <source>Put the axis through MapCentre; otherwise through the middle of the solid's box</source>
      <translation>Fa passare l'asse per MapCentre; altrimenti per il centro del parallelepipedo del solido</translation>
    </message>
    <message>
      <source>Quadratic</source>
      <translation>Quadratica</translation>
    </message>
    <message>
      <source>Radius</source>
      <translation>Raggio</translation>
    </message>
    <message>
      <source>Radius Column</source>
      <translation>Colonna dei valori</translation>
    </message>
    <message>
      <source>Radius Curve</source>
      <translation>Curva del raggio</translation>
    </message>
    <message>
      <source>Radius Direction</source>
      <translation>Direzione del raggio</translation>
    </message>
    <message>
      <source>Radius Driven By</source>
      <translation>Raggio determinato da</translation>
    </message>
    <message>
      <source>Radius End</source>
      <translation>Raggio alla fine</translation>
    </message>
    <message>
      <source>Radius Field</source>
      <translation>Campo del raggio</translation>
    </message>
    <message>
      <source>Radius Formula</source>
      <translation>Formula del raggio</translation>
    </message>
    <message>
      <source>Radius Grading</source>
      <translation>Gradazione del raggio</translation>
    </message>
    <message>
      <source>Radius Profile</source>
      <translation>Profilo del raggio</translation>
    </message>
    <message>
      <source>Radius Reach</source>
      <translation>Portata del raggio</translation>
    </message>
    <message>
      <source>Radius Result</source>
      <translation>Risultato FEM</translation>
    </message>
    <message>
      <source>Radius Start</source>
      <translation>Raggio all'inizio</translation>
    </message>
    <message>
      <source>Radius at s = 0, or where the field is smallest; 0 for the strut radius</source>
      <translation>Raggio in s = 0, o dove il campo è minimo; 0 per il raggio delle aste</translation>
    </message>
    <message>
      <source>Radius at s = 1, or where the field is largest; 0 for the strut radius</source>
      <translation>Raggio in s = 1, o dove il campo è massimo; 0 per il raggio delle aste</translation>
    </message>
    <message>
      <source>Radius in mm as a formula of s</source>
      <translation>Raggio in mm come formula di s</translation>
    </message>
    <message>
      <source>Radius of the round between struts where they meet; 0 for none</source>
      <translation>Raggio del raccordo tra le aste dove si incontrano; 0 per nessuno</translation>
    </message>
    <message>
      <source>Reach</source>
      <translation>Portata</translation>
    </message>
    <message>
      <source>Refused</source>
      <translation>Rifiutati</translation>
    </message>
    <message>
      <source>Relative Density</source>
      <translation>Densità relativa</translation>
    </message>
    <message>
      <source>Relative density</source>
      <translation>Densità relativa</translation>
    </message>
    <message>
      <source>Remove Below</source>
      <translation>Rimuovi sotto</translation>
    </message>
    <message>
      <source>Remove Dangling</source>
      <translation>Togli aste pendenti</translation>
    </message>
    <message>
      <source>Remove Flatter</source>
      <translation>Togli le più piatte</translation>
    </message>
    <message>
      <source>Report</source>
      <translation>Rapporto</translation>
    </message>
    <message>
      <source>Resolution</source>
      <translation>Risoluzione</translation>
    </message>
    <message>
      <source>Result</source>
      <translation>Risultato</translation>
    </message>
    <message>
      <source>Result of a FEM solver, instead of a file</source>
      <translation>Risultato di un solutore FEM, al posto di un file</translation>
    </message>
    <message>
      <source>Scalar</source>
      <translation>Scalare</translation>
    </message>
    <message>
      <source>Seconds</source>
      <translation>Secondi</translation>
    </message>
    <message>
      <source>Separate pieces of material</source>
      <translation>Pezzi di materiale separati</translation>
    </message>
    <message>
      <source>Sheet</source>
      <translation>Parete</translation>
    </message>
    <message>
      <source>Shell Thickness</source>
      <translation>Spessore del guscio</translation>
    </message>
    <message>
      <source>Short struts with a free end, taken away</source>
      <translation>Aste corte con un'estremità libera, tolte</translation>
    </message>
    <message>
      <source>Shortest Stub</source>
      <translation>Moncone minimo</translation>
    </message>
    <message>
      <source>Shortest and longest edge of a cell, mm</source>
      <translation>Spigolo più corto e più lungo di una cella, mm</translation>
    </message>
    <message>
      <source>Shortest and longest strut, mm</source>
      <translation>Asta più corta e più lunga, mm</translation>
    </message>
    <message>
      <source>Size Grading</source>
      <translation>Gradazione celle</translation>
    </message>
    <message>
      <source>Skeleton</source>
      <translation>Scheletro</translation>
    </message>
    <message>
      <source>Skin</source>
      <translation>Guscio</translation>
    </message>
    <message>
      <source>Skin Faces</source>
      <translation>Facce con guscio proprio</translation>
    </message>
    <message>
      <source>Skin Field</source>
      <translation>Campo dello spessore del guscio</translation>
    </message>
    <message>
      <source>Skin Follows Sizing</source>
      <translation>Guscio come dimensionato</translation>
    </message>
    <message>
      <source>Skin Thicknesses</source>
      <translation>Spessori del guscio</translation>
    </message>
    <message>
      <source>Slicer</source>
      <translation>Slicer</translation>
    </message>
    <message>
      <source>Smallest and largest strut radius, mm</source>
      <translation>Raggio minimo e massimo delle aste, mm</translation>
    </message>
    <message>
      <source>Smallest diameter of a strut, mm</source>
      <translation>Diametro minimo di un'asta, mm</translation>
    </message>
    <message>
      <source>Solid</source>
      <translation>Solido</translation>
    </message>
    <message>
      <source>Solid Volume</source>
      <translation>Volume pieno</translation>
    </message>
    <message>
      <source>Solid ones above what looks down</source>
      <translation>Pieni sopra ciò che guarda in basso</translation>
    </message>
    <message>
      <source>Solid ones below what looks up</source>
      <translation>Pieni sotto ciò che guarda in alto</translation>
    </message>
    <message>
      <source>Sparse infill in each band, mm3</source>
      <translation>Riempimento rado in ogni banda, mm3</translation>
    </message>
    <message>
      <source>Spherical</source>
      <translation>Sferica</translation>
    </message>
    <message>
      <source>Status</source>
      <translation>Stato</translation>
    </message>
    <message>
      <source>Status Shown</source>
      <translation>Condizione</translation>
    </message>
    <message>
      <source>Stiffness</source>
      <translation>Rigidezza</translation>
    </message>
    <message>
      <source>Stiffness Direction</source>
      <translation>Direzione della rigidezza</translation>
    </message>
    <message>
      <source>Strut Lengths</source>
      <translation>Lunghezze delle aste</translation>
    </message>
    <message>
      <source>Strut Radii</source>
      <translation>Raggi delle aste</translation>
    </message>
    <message>
      <source>Strut Radius</source>
      <translation>Raggio delle aste</translation>
    </message>
    <message>
      <source>Strut radius</source>
      <translation>Raggio delle aste</translation>
    </message>
    <message>
      <source>Struts</source>
      <translation>Aste</translation>
    </message>
    <message>
      <source>Struts of the lattice before trimming</source>
      <translation>Aste del reticolo prima del taglio</translation>
    </message>
    <message>
      <source>Struts run along the wall, too, where it cuts the faces of the points' cells</source>
      <translation>Le aste corrono anche sulla parete, dove questa taglia le facce delle celle dei punti</translation>
    </message>
    <message>
      <source>Struts shorter than this are drawn together into one node; 0 for four radii</source>
      <translation>Le aste più corte sono riunite in un nodo; 0 per quattro raggi</translation>
    </message>
    <message>
      <source>Struts whose radius varies: along a direction, by the depth below the skin (s = 1 at the skin, or at the core), or by a field of values</source>
      <translation>Aste di raggio variabile: lungo una direzione, con la profondità sotto il guscio (s = 1 al guscio, o al nucleo), o secondo un campo di valori</translation>
    </message>
    <message>
      <source>Struts with a free end that were taken away</source>
      <translation>Aste con un'estremità libera che sono state tolte</translation>
    </message>
    <message>
      <source>Stubs Removed</source>
      <translation>Monconi rimossi</translation>
    </message>
    <message>
      <source>Study</source>
      <translation>Studio</translation>
    </message>
    <message>
      <source>Surface Area</source>
      <translation>Area della superficie</translation>
    </message>
    <message>
      <source>Table</source>
      <translation>Tabella</translation>
    </message>
    <message>
      <source>Take away struts that are nowhere thicker than this radius; 0 for none</source>
      <translation>Toglie le aste che in nessun punto sono più spesse di questo raggio; 0 per nessuna</translation>
    </message>
    <message>
      <source>Take away struts that lie flatter than so many degrees to the build plate, and those with a free end then; 0 for none</source>
      <translation>Toglie le aste inclinate di meno di questi gradi rispetto al piano di stampa, e quelle che poi hanno un'estremità libera; 0 per nessuna</translation>
    </message>
    <message>
      <source>Take away struts with a free end that are shorter than this; 0 for none</source>
      <translation>Toglie le aste con un'estremità libera più corte di così; 0 per nessuna</translation>
    </message>
    <message>
      <source>Take away struts with a free end, again and again until there are none</source>
      <translation>Toglie le aste con un'estremità libera, finché non ne rimane nessuna</translation>
    </message>
    <message>
      <source>Target Density</source>
      <translation>Densità obiettivo</translation>
    </message>
    <message>
      <source>Target Mass</source>
      <translation>Massa obiettivo</translation>
    </message>
    <message>
      <source>Target Stiffness</source>
      <translation>Rigidezza obiettivo</translation>
    </message>
    <message>
      <source>Text</source>
      <translation>Testo</translation>
    </message>
    <message>
      <source>That gets out of the lattice, mm; for powder</source>
      <translation>Che esce dal reticolo, mm; per la polvere</translation>
    </message>
    <message>
      <source>That the slicer lays</source>
      <translation>Che lo slicer depone</translation>
    </message>
    <message>
      <source>The .json file of your own unit cell (nodes and struts), for the cell type Custom</source>
      <translation>Il file .json di una cella propria (nodi e aste), per il tipo di cella Custom</translation>
    </message>
    <message>
      <source>The .toml or .json file of your own material</source>
      <translation>Il file .toml o .json del proprio materiale</translation>
    </message>
    <message>
      <source>The lattice infill to look at</source>
      <translation>Il riempimento reticolare da esaminare</translation>
    </message>
    <message>
      <source>The lattice infill whose designs these are</source>
      <translation>Il riempimento reticolare di cui questi sono i progetti</translation>
    </message>
    <message>
      <source>The one density everywhere that takes the same filament, percent</source>
      <translation>La densità unica ovunque che richiede lo stesso filamento, percento</translation>
    </message>
    <message>
      <source>The radius varies along it</source>
      <translation>Il raggio varia lungo di essa</translation>
    </message>
    <message>
      <source>The skin has the thickness that Loads and Sizing has found, and nowhere less than ShellThickness</source>
      <translation>Il guscio ha lo spessore trovato da Carichi e dimensionamento, e mai meno di ShellThickness</translation>
    </message>
    <message>
      <source>The solid that is printed</source>
      <translation>Il solido da stampare</translation>
    </message>
    <message>
      <source>The solid to fill: a solid, a Body, a Part, a link to one of these, or a closed mesh</source>
      <translation>Il solido da riempire: un solido, un Body, una Part, un link a uno di questi o una mesh chiusa</translation>
    </message>
    <message>
      <source>The status in your language; not saved</source>
      <translation>Lo stato nella propria lingua; non salvato</translation>
    </message>
    <message>
      <source>The surface of the cell Formula: zero on it, of x, y and z, which run from 0 to 2 pi over a cell</source>
      <translation>La superficie della cella Formula: zero su di essa, di x, y e z, che vanno da 0 a 2 pi su una cella</translation>
    </message>
    <message>
      <source>The unit cell: one of the library, a TPMS such as Gyroid, or the .json file of your own</source>
      <translation>La cella unitaria: una della libreria, una TPMS come Gyroid, o il file .json di una propria</translation>
    </message>
    <message>
      <source>Their volume</source>
      <translation>Il loro volume</translation>
    </message>
    <message>
      <source>Thickness of a sheet, measured across it</source>
      <translation>Spessore di una parete, misurato attraverso di essa</translation>
    </message>
    <message>
      <source>Thickness of the closed skin; 0 for none: the lattice is cut at the outer surface</source>
      <translation>Spessore del guscio chiuso; 0 per nessuno: il reticolo è tagliato alla superficie esterna</translation>
    </message>
    <message>
      <source>Thickness of the skin below each of the SkinFaces, in mm; 0 leaves the face open</source>
      <translation>Spessore del guscio sotto ognuna delle SkinFaces, in mm; 0 lascia la faccia aperta</translation>
    </message>
    <message>
      <source>Thinnest Strut</source>
      <translation>Asta più sottile</translation>
    </message>
    <message>
      <source>Thinnest Wall</source>
      <translation>Parete più sottile</translation>
    </message>
    <message>
      <source>Through-holes of the mesh</source>
      <translation>Fori passanti della mesh</translation>
    </message>
    <message>
      <source>Told Densities</source>
      <translation>Densità comunicate</translation>
    </message>
    <message>
      <source>Top Layers</source>
      <translation>Strati superiori</translation>
    </message>
    <message>
      <source>Touching</source>
      <translation>A contatto</translation>
    </message>
    <message>
      <source>Triangles</source>
      <translation>Triangoli</translation>
    </message>
    <message>
      <source>Triangles of the mesh</source>
      <translation>Triangoli della mesh</translation>
    </message>
    <message>
      <source>Trim</source>
      <translation>Taglio</translation>
    </message>
    <message>
      <source>Turn about the position of Orientation; otherwise about the middle of the solid's box</source>
      <translation>Ruota attorno alla posizione di Orientation; altrimenti attorno al centro del parallelepipedo del solido</translation>
    </message>
    <message>
      <source>Turns the lattice, not the solid: about this axis, by this angle, counter-clockwise seen against it; cells then begin at a corner of the box that is turned with them</source>
      <translation>Ruota il reticolo, non il solido: attorno a questo asse, di questo angolo, in senso antiorario visto contro di esso; le celle iniziano allora a un angolo del parallelepipedo ruotato con loro</translation>
    </message>
    <message>
      <source>Two faces between which cells lie, or one upon which they do; each has four sides</source>
      <translation>Due facce tra cui stanno le celle, o una su cui stanno; ognuna ha quattro lati</translation>
    </message>
    <message>
      <source>Use Map Centre</source>
      <translation>Usa centro</translation>
    </message>
    <message>
      <source>Use Origin</source>
      <translation>Usa origine</translation>
    </message>
    <message>
      <source>Use Rotation Origin</source>
      <translation>Usa origine della rotazione</translation>
    </message>
    <message>
      <source>Values and their radii in mm, such as '0:0.5, 120:1.2', in place of the start and the end</source>
      <translation>Valori e i loro raggi in mm, come '0:0.5, 120:1.2', al posto dell'inizio e della fine</translation>
    </message>
    <message>
      <source>Vary</source>
      <translation>Varia</translation>
    </message>
    <message>
      <source>Void Volume</source>
      <translation>Volume dei vuoti</translation>
    </message>
    <message>
      <source>Voids</source>
      <translation>Vuoti</translation>
    </message>
    <message>
      <source>Volume</source>
      <translation>Volume</translation>
    </message>
    <message>
      <source>Volume of material</source>
      <translation>Volume di materiale</translation>
    </message>
    <message>
      <source>Volume of the lattice over that of what it fills, between 0 and 1</source>
      <translation>Volume del reticolo diviso per quello che riempie, fra 0 e 1</translation>
    </message>
    <message>
      <source>Volume of the lattice over what it fills</source>
      <translation>Volume del reticolo su quello che riempie</translation>
    </message>
    <message>
      <source>Voronoi</source>
      <translation>Voronoi</translation>
    </message>
    <message>
      <source>Wall Formula</source>
      <translation>Formula delle pareti</translation>
    </message>
    <message>
      <source>Wall Kind</source>
      <translation>Tipo di pareti</translation>
    </message>
    <message>
      <source>Wall Offset</source>
      <translation>Scostamento delle pareti</translation>
    </message>
    <message>
      <source>Wall Thickness</source>
      <translation>Spessore delle pareti</translation>
    </message>
    <message>
      <source>Walls</source>
      <translation>Pareti</translation>
    </message>
    <message>
      <source>Warnings</source>
      <translation>Avvisi</translation>
    </message>
    <message>
      <source>Watertight</source>
      <translation>Stagno</translation>
    </message>
    <message>
      <source>What an update of these properties comes to</source>
      <translation>Quanto comporta un aggiornamento di queste proprietà</translation>
    </message>
    <message>
      <source>What does not suit the process</source>
      <translation>Ciò che non si adatta al processo</translation>
    </message>
    <message>
      <source>What sets the struts' radius: itself, or a target of the lattice or the part, for which it is found</source>
      <translation>Che cosa determina il raggio delle aste: il raggio stesso, o un obiettivo del reticolo o del pezzo, per cui viene trovato</translation>
    </message>
    <message>
      <source>What the density follows</source>
      <translation>Ciò che la densità segue</translation>
    </message>
    <message>
      <source>What the figures are of</source>
      <translation>A che cosa si riferiscono i valori</translation>
    </message>
    <message>
      <source>What the lattice consists of: cells, Voronoi or Delaunay edges of random points, nodes and struts of a file, or layers of cells that follow faces picked in FreeCAD</source>
      <translation>Di cosa consiste il reticolo: celle, spigoli di Voronoi o Delaunay di punti casuali, nodi e aste di un file, o strati di celle che seguono facce scelte in FreeCAD</translation>
    </message>
    <message>
      <source>What the lattice is coloured by</source>
      <translation>In base a cosa è colorato il reticolo</translation>
    </message>
    <message>
      <source>What the part is made of: its density gives the mass, its stiffness goes into solver decks</source>
      <translation>Di che cosa è fatto il pezzo: la densità dà la massa, la rigidezza va nei file per i solutori</translation>
    </message>
    <message>
      <source>What the slicer is told of each, so that it lays as much, percent</source>
      <translation>Ciò che si dice allo slicer di ciascuna, perché deponga altrettanto, percento</translation>
    </message>
    <message>
      <source>What to know about this result</source>
      <translation>Ciò che va saputo di questo risultato</translation>
    </message>
    <message>
      <source>Where cells are stretched or bent, struts stay straight and round; otherwise they are deformed with their cells, as published</source>
      <translation>Dove le celle sono stirate o curvate, le aste restano diritte e tonde; altrimenti si deformano con le loro celle, come pubblicato</translation>
    </message>
    <message>
      <source>Where holes go through the skin</source>
      <translation>Dove i fori attraversano il guscio</translation>
    </message>
    <message>
      <source>Where the records and the page of the study are</source>
      <translation>Dove sono le registrazioni e la pagina dello studio</translation>
    </message>
    <message>
      <source>Where the scale of colours begins; as its end: from the values themselves</source>
      <translation>Dove comincia la scala dei colori; uguale alla fine: dai valori stessi</translation>
    </message>
    <message>
      <source>Where the scale of colours ends</source>
      <translation>Dove finisce la scala dei colori</translation>
    </message>
    <message>
      <source>Whether the bands are those of these values</source>
      <translation>Se le bande sono quelle di questi valori</translation>
    </message>
    <message>
      <source>Whether the mesh fits the properties, or why not</source>
      <translation>Se la mesh corrisponde alle proprietà, o perché no</translation>
    </message>
    <message>
      <source>Which cells hold a lattice: those that touch the inside, whose centre lies inside, or that lie wholly inside</source>
      <translation>Quali celle contengono il reticolo: quelle che toccano l'interno, che vi hanno il centro o che vi stanno del tutto</translation>
    </message>
    <message>
      <source>Which values of the file or the FEM result; empty for the only ones, or for vonMises</source>
      <translation>Quali valori del file o del risultato FEM; vuoto per gli unici, o per vonMises</translation>
    </message>
    <message>
      <source>Which values of the file or the FEM result; empty for the usual ones</source>
      <translation>Quali valori del file o del risultato FEM; vuoto per quelli usuali</translation>
    </message>
    <message>
      <source>Whole</source>
      <translation>Intere</translation>
    </message>
    <message>
      <source>Why combinations were passed over, or failed</source>
      <translation>Perché alcune combinazioni sono state saltate o sono fallite</translation>
    </message>
    <message>
      <source>Young's modulus of the lattice along StiffnessDirection, of the chosen material</source>
      <translation>Modulo di Young del reticolo lungo StiffnessDirection, del materiale scelto</translation>
    </message>
    <message>
      <source>lambda as a formula of s</source>
      <translation>lambda come formula di s</translation>
    </message>
    <message>
      <source>lambda at the far end, s = 1</source>
      <translation>lambda all'estremità lontana, s = 1</translation>
    </message>
    <message>
      <source>lambda at the near end, s = 0</source>
      <translation>lambda all'estremità vicina, s = 0</translation>
    </message>
    <message>
      <source>part: skin and lattice; lattice: without the skin; domain: what the lattice fills</source>
      <translation>part: guscio e reticolo; lattice: senza guscio; domain: ciò che il reticolo riempie</translation>
    </message>
    <message>
      <source>r: radius of the struts</source>
      <translation>r: raggio delle aste</translation>
    </message>
    <message>
      <source>sheet: a wall about the surface; skeleton: where its formula is negative; complement: where it is positive</source>
      <translation>sheet: una parete attorno alla superficie; skeleton: dove la sua formula è negativa; complement: dove è positiva</translation>
    </message>
    <message>
      <source>trim: the lattice is cut at the wall; whole: cells stay whole, and a skin joins what reaches it</source>
      <translation>taglio (trim): il reticolo è tagliato alla parete; intere (whole): le celle restano intere, e un guscio unisce ciò che lo raggiunge</translation>
    </message>
    <message>
      <source>value:percent pairs in place of start and end, such as 0:10, 80:60</source>
      <translation>Coppie valore:percento al posto di inizio e fine, come 0:10, 80:60</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_CellLibrary</name>
    <message>
      <source>Browse the unit cells, load your own, make one of a sketch, and give it to a lattice infill</source>
      <translation>Sfoglia le celle unitarie, caricane di tue, creane una da uno schizzo e assegnala a un riempimento reticolare</translation>
    </message>
    <message>
      <source>Cell Library</source>
      <translation>Libreria di celle</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_CheckGroup</name>
    <message>
      <source>Check</source>
      <translation>Controllare</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_CheckMesh</name>
    <message>
      <source>Check Mesh</source>
      <translation>Controlla mesh</translation>
    </message>
    <message>
      <source>Report on the selected mesh: closed, bodies, volume, angles, triangles that cross, and what a file keeps of it</source>
      <translation>Rapporto sulla mesh selezionata: chiusura, corpi, volume, angoli, triangoli che si incrociano e ciò che ne resta in un file</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ColourBy</name>
    <message>
      <source>Colour By</source>
      <translation>Colora per</translation>
    </message>
    <message>
      <source>Colour the selected lattice infill by radius, cell size, overhang, stress or another quantity, with a legend, and read off values with the mouse</source>
      <translation>Colora il riempimento selezionato per raggio, dimensione delle celle, sbalzo, tensione o un'altra grandezza, con legenda, e legge i valori con il mouse</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Coupons</name>
    <message>
      <source>Coupons</source>
      <translation>Provini</translation>
    </message>
    <message>
      <source>Make specimens of the selected infill's lattice to print, press, pull and measure, numbered in relief</source>
      <translation>Crea provini del reticolo del riempimento selezionato da stampare, premere, tirare e misurare, numerati in rilievo</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_DesignStudy</name>
    <message>
      <source>Apply Design</source>
      <translation>Applica progetto</translation>
    </message>
    <message>
      <source>Design Study</source>
      <translation>Studio di progetto</translation>
    </message>
    <message>
      <source>Try many values of the selected lattice infill's properties, see mass against stiffness, and give it the best</source>
      <translation>Prova molti valori delle proprietà del riempimento reticolare selezionato, confronta massa e rigidezza e applica i migliori</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Edit</name>
    <message>
      <source>Change the selected lattice infill in its panel, with a preview</source>
      <translation>Modifica il riempimento reticolare selezionato nel suo pannello, con un'anteprima</translation>
    </message>
    <message>
      <source>Edit Lattice Infill</source>
      <translation>Modifica riempimento reticolare</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ExampleBracket</name>
    <message>
      <source>Bracket</source>
      <translation>Staffa</translation>
    </message>
    <message>
      <source>Open a bracket on four bolts, filled with a lattice, in a new document</source>
      <translation>Apre in un nuovo documento una staffa a quattro bulloni, riempita di reticolo</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ExamplePistonRod</name>
    <message>
      <source>Open a piston rod, filled with a lattice, in a new document</source>
      <translation>Apre in un nuovo documento una biella riempita di reticolo</translation>
    </message>
    <message>
      <source>Piston Rod</source>
      <translation>Biella</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Export</name>
    <message>
      <source>Export Lattice</source>
      <translation>Esporta reticolo</translation>
    </message>
    <message>
      <source>Write the selected lattice infill for the printer (STL, 3MF with or without beams, PLY, OBJ, layers), for CAD (STEP) or for CalculiX</source>
      <translation>Scrive il riempimento reticolare selezionato per la stampante (STL, 3MF con o senza travi, PLY, OBJ, strati), per il CAD (STEP) o per CalculiX</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ExportGroup</name>
    <message>
      <source>Export</source>
      <translation>Esportare</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_FemAnalysis</name>
    <message>
      <source>FEM Analysis</source>
      <translation>Analisi FEM</translation>
    </message>
    <message>
      <source>Make an analysis of the selected lattice infill for the FEM workbench, of beams or of tetrahedra, ready for constraints</source>
      <translation>Crea per l'ambiente FEM un'analisi del riempimento reticolare selezionato, di travi o di tetraedri, pronta per i vincoli</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Help</name>
    <message>
      <source>Read about every command, and a tutorial of five minutes</source>
      <translation>Tutto su ogni comando, e un'esercitazione di cinque minuti</translation>
    </message>
    <message>
      <source>VOLFREP Help</source>
      <translation>Guida di VOLFREP</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_LatticeInfill</name>
    <message>
      <source>Lattice Infill</source>
      <translation>Riempimento reticolare</translation>
    </message>
    <message>
      <source>Make the selected solid light: a closed skin and a strut lattice inside</source>
      <translation>Alleggerisce il solido selezionato: un guscio chiuso e dentro un reticolo di aste</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_LoadsGroup</name>
    <message>
      <source>Loads</source>
      <translation>Carichi</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_LookGroup</name>
    <message>
      <source>Look</source>
      <translation>Guardare</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_MakeGroup</name>
    <message>
      <source>Make</source>
      <translation>Creare</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_OpenFaces</name>
    <message>
      <source>Open Faces</source>
      <translation>Apri facce</translation>
    </message>
    <message>
      <source>Select a lattice infill and faces of its solid: they get no skin</source>
      <translation>Seleziona un riempimento reticolare e facce del suo solido: resteranno senza guscio</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Orient</name>
    <message>
      <source>Build Direction</source>
      <translation>Direzione di costruzione</translation>
    </message>
    <message>
      <source>Find how the selected lattice infill, or solid, is built with the least overhang and support, and turn it so</source>
      <translation>Trova come il riempimento reticolare o il solido selezionato si costruisce con meno sporgenze e supporti, e lo ruota così</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_PreviewOnly</name>
    <message>
      <source>Preview Only</source>
      <translation>Solo anteprima</translation>
    </message>
    <message>
      <source>Show the struts of the selected lattice infill and their figures without making a mesh; once more takes them away</source>
      <translation>Mostra le aste del riempimento reticolare selezionato e i loro dati senza creare la mesh; di nuovo per toglierle</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_PrintCheck</name>
    <message>
      <source>Print Check</source>
      <translation>Controllo di stampa</translation>
    </message>
    <message>
      <source>See what hangs over, is too thin or holds powder when the selected lattice infill is printed</source>
      <translation>Mostra ciò che sporge, è troppo sottile o trattiene polvere quando si stampa il riempimento reticolare selezionato</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_SectionView</name>
    <message>
      <source>Cut the selected lattice open on the screen, along a plane that can be moved; the lattice itself stays whole</source>
      <translation>Apre sullo schermo il reticolo selezionato lungo un piano che si può spostare; il reticolo stesso resta intero</translation>
    </message>
    <message>
      <source>Section View</source>
      <translation>Vista in sezione</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_SizeLattice</name>
    <message>
      <source>Loads and Sizing</source>
      <translation>Carichi e dimensionamento</translation>
    </message>
    <message>
      <source>Pick what holds and loads the selected lattice infill, or solid, and find the radii of its struts: least mass within limits, or most stiffness at a mass</source>
      <translation>Scegliere che cosa vincola e carica il riempimento o il solido selezionato, e trovare i raggi delle aste: massa minima entro i limiti, o massima rigidezza a una data massa</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_SlicerInfill</name>
    <message>
      <source>Let a slicer print the selected solid with an infill that is denser where a field says: bands of density that follow the solid, for PrusaSlicer, OrcaSlicer and Bambu Studio</source>
      <translation>Fa stampare a uno slicer il solido selezionato con un riempimento più denso dove lo dice un campo: bande di densità che seguono il solido, per PrusaSlicer, OrcaSlicer e Bambu Studio</translation>
    </message>
    <message>
      <source>Slicer Infill</source>
      <translation>Riempimento per slicer</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_SolidBeside</name>
    <message>
      <source>Show the solid beside the selected lattice infill; once more takes it away</source>
      <translation>Mostra il solido accanto al riempimento selezionato; di nuovo lo toglie</translation>
    </message>
    <message>
      <source>Solid Beside</source>
      <translation>Solido accanto</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Statistics</name>
    <message>
      <source>Statistics</source>
      <translation>Statistiche</translation>
    </message>
    <message>
      <source>Tables of the selected lattice infills, or of all in the document: cells, struts, density, mass, times, memory</source>
      <translation>Tabelle dei riempimenti reticolari selezionati, o di tutti quelli del documento: celle, aste, densità, massa, tempi, memoria</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_StrutResults</name>
    <message>
      <source>Colour the struts of the selected lattice infill by radius, stress, buckling or displacement under the load cases of the FEM workbench</source>
      <translation>Colora le aste del riempimento reticolare selezionato per raggio, tensione, instabilità o spostamento sotto i casi di carico dell'ambiente FEM</translation>
    </message>
    <message>
      <source>Strut Results</source>
      <translation>Risultati delle aste</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_ToSolid</name>
    <message>
      <source>Lattice To Solid</source>
      <translation>Reticolo in solido</translation>
    </message>
    <message>
      <source>Make a Part solid of exact surfaces or of plane faces, links to its joints, or the struts' axes</source>
      <translation>Crea un solido Part di superfici esatte o di facce piane, link ai suoi nodi, o gli assi delle aste</translation>
    </message>
  </context>
  <context>
    <name>VOLFREP_Update</name>
    <message>
      <source>Compute the selected lattice infill now, also with AutoUpdate off</source>
      <translation>Calcola ora il riempimento reticolare selezionato, anche con AutoUpdate disattivato</translation>
    </message>
    <message>
      <source>Update Lattice Infill</source>
      <translation>Aggiorna riempimento reticolare</translation>
    </message>
  </context>
  <context>
    <name>VolfrepCells</name>
    <message>
      <source>All cells</source>
      <translation>Tutte le celle</translation>
    </message>
    <message>
      <source>Also known as</source>
      <translation>Nota anche come</translation>
    </message>
    <message>
      <source>Apply</source>
      <translation>Applica</translation>
    </message>
    <message>
      <source>Apply to {label}</source>
      <translation>Applica a {label}</translation>
    </message>
    <message>
      <source>Carries load by</source>
      <translation>Porta il carico per</translation>
    </message>
    <message>
      <source>Cell size L</source>
      <translation>Dimensione cella L</translation>
    </message>
    <message>
      <source>Close</source>
      <translation>Chiudi</translation>
    </message>
    <message>
      <source>Compute</source>
      <translation>Calcola</translation>
    </message>
    <message>
      <source>Drawn with L = {size:g} mm; every L can be given to an infill.</source>
      <translation>Disegnata con L = {size:g} mm; a un riempimento si può dare qualsiasi L.</translation>
    </message>
    <message>
      <source>File</source>
      <translation>File</translation>
    </message>
    <message>
      <source>Find cells by their stiffness and density, in a chart</source>
      <translation>Trova celle per rigidezza e densità, in un grafico</translation>
    </message>
    <message>
      <source>Find...</source>
      <translation>Trova...</translation>
    </message>
    <message>
      <source>From Selection</source>
      <translation>Da selezione</translation>
    </message>
    <message>
      <source>Give the picked cell to the selected lattice infill</source>
      <translation>Assegna la cella scelta al riempimento reticolare selezionato</translation>
    </message>
    <message>
      <source>Good for</source>
      <translation>Adatta per</translation>
    </message>
    <message>
      <source>Homogenise this cell with this radius: it takes some seconds</source>
      <translation>Omogeneizza questa cella con questo raggio: richiede alcuni secondi</translation>
    </message>
    <message>
      <source>Load Cell</source>
      <translation>Carica cella</translation>
    </message>
    <message>
      <source>Load...</source>
      <translation>Carica...</translation>
    </message>
    <message>
      <source>Make a cell of the straight edges of the selected sketches, wires or shapes; the cube about them is the cell</source>
      <translation>Crea una cella dai bordi rettilinei degli schizzi, fili o forme selezionati; il cubo che li contiene è la cella</translation>
    </message>
    <message>
      <source>Material</source>
      <translation>Materiale</translation>
    </message>
    <message>
      <source>Maxwell number</source>
      <translation>Numero di Maxwell</translation>
    </message>
    <message>
      <source>Nodes</source>
      <translation>Nodi</translation>
    </message>
    <message>
      <source>Properties of {name}</source>
      <translation>Proprietà di {name}</translation>
    </message>
    <message>
      <source>Read a cell of your own from a JSON file</source>
      <translation>Legge una cella propria da un file JSON</translation>
    </message>
    <message>
      <source>Save As...</source>
      <translation>Salva con nome...</translation>
    </message>
    <message>
      <source>Save Cell</source>
      <translation>Salva cella</translation>
    </message>
    <message>
      <source>Set Unit Cell</source>
      <translation>Imposta cella unitaria</translation>
    </message>
    <message>
      <source>Sheet thickness</source>
      <translation>Spessore della parete</translation>
    </message>
    <message>
      <source>Strut radius r</source>
      <translation>Raggio aste r</translation>
    </message>
    <message>
      <source>Struts</source>
      <translation>Aste</translation>
    </message>
    <message>
      <source>The properties of this TPMS take some seconds: press Compute.</source>
      <translation>Le proprietà di questa TPMS richiedono alcuni secondi: premere Calcola.</translation>
    </message>
    <message>
      <source>This cell with this radius is not in the catalogue: press Compute.</source>
      <translation>Questa cella con questo raggio non è nel catalogo: premere Calcola.</translation>
    </message>
    <message>
      <source>Unit cell (*.json)</source>
      <translation>Cella unitaria (*.json)</translation>
    </message>
    <message>
      <source>Write the picked cell to a JSON file</source>
      <translation>Scrive la cella scelta in un file JSON</translation>
    </message>
    <message>
      <source>auxetic: wider when pulled</source>
      <translation>auxetica: si allarga se tirata</translation>
    </message>
    <message>
      <source>bending</source>
      <translation>flessione</translation>
    </message>
    <message>
      <source>not saved</source>
      <translation>non salvata</translation>
    </message>
    <message>
      <source>open: flow, bone, foams</source>
      <translation>aperta: flusso, osso, schiume</translation>
    </message>
    <message>
      <source>soft: energy, vibration</source>
      <translation>cedevole: energia, vibrazioni</translation>
    </message>
    <message>
      <source>stiff along its columns</source>
      <translation>rigida lungo le colonne</translation>
    </message>
    <message>
      <source>stiff in every direction</source>
      <translation>rigida in ogni direzione</translation>
    </message>
    <message>
      <source>stretching</source>
      <translation>trazione e compressione</translation>
    </message>
    <message>
      <source>walls along a surface</source>
      <translation>pareti lungo una superficie</translation>
    </message>
  </context>
  <context>
    <name>VolfrepColours</name>
    <message>
      <source>Automatic</source>
      <translation>Automatico</translation>
    </message>
    <message>
      <source>Buckling</source>
      <translation>Instabilità</translation>
    </message>
    <message>
      <source>Cell size</source>
      <translation>Dimensione delle celle</translation>
    </message>
    <message>
      <source>Cell size, mm</source>
      <translation>Dimensione delle celle, mm</translation>
    </message>
    <message>
      <source>Colour by</source>
      <translation>Colora per</translation>
    </message>
    <message>
      <source>Colours of {label}</source>
      <translation>Colori di {label}</translation>
    </message>
    <message>
      <source>Deformed</source>
      <translation>Deformato</translation>
    </message>
    <message>
      <source>Displacement</source>
      <translation>Spostamento</translation>
    </message>
    <message>
      <source>Displacement, mm</source>
      <translation>Spostamento, mm</translation>
    </message>
    <message>
      <source>Displacements enlarged; 0: automatic</source>
      <translation>Ingrandimento degli spostamenti; 0: automatico</translation>
    </message>
    <message>
      <source>Field</source>
      <translation>Campo</translation>
    </message>
    <message>
      <source>Field of the radius</source>
      <translation>Campo del raggio</translation>
    </message>
    <message>
      <source>From the smallest to the largest of the values</source>
      <translation>Dal più piccolo al più grande dei valori</translation>
    </message>
    <message>
      <source>Governing limit</source>
      <translation>Limite determinante</translation>
    </message>
    <message>
      <source>Governing limit of the skin</source>
      <translation>Limite determinante del guscio</translation>
    </message>
    <message>
      <source>Load case</source>
      <translation>Caso di carico</translation>
    </message>
    <message>
      <source>Move the mouse over the lattice to read values</source>
      <translation>Muovere il mouse sul reticolo per leggere i valori</translation>
    </message>
    <message>
      <source>No stresses are kept in the document: Loads and Sizing puts them there.</source>
      <translation>Nel documento non ci sono tensioni: Carichi e dimensionamento ve le mette.</translation>
    </message>
    <message>
      <source>None</source>
      <translation>Nessuno</translation>
    </message>
    <message>
      <source>Of struts as printed ({table}).</source>
      <translation>Di aste come stampate ({table}).</translation>
    </message>
    <message>
      <source>Overhang</source>
      <translation>Sbalzo</translation>
    </message>
    <message>
      <source>Overhang, degrees</source>
      <translation>Sbalzo, gradi</translation>
    </message>
    <message>
      <source>Picture</source>
      <translation>Immagine</translation>
    </message>
    <message>
      <source>Radius</source>
      <translation>Raggio</translation>
    </message>
    <message>
      <source>Radius, mm</source>
      <translation>Raggio, mm</translation>
    </message>
    <message>
      <source>Save the view with its legend, on white, for a report</source>
      <translation>Salvare la vista con la sua legenda, su bianco, per una relazione</translation>
    </message>
    <message>
      <source>Share of the buckling load</source>
      <translation>Quota del carico critico</translation>
    </message>
    <message>
      <source>Skin</source>
      <translation>Guscio</translation>
    </message>
    <message>
      <source>Skin thickness, mm</source>
      <translation>Spessore del guscio, mm</translation>
    </message>
    <message>
      <source>Stress</source>
      <translation>Tensione</translation>
    </message>
    <message>
      <source>Stress (von Mises), MPa</source>
      <translation>Tensione (von Mises), MPa</translation>
    </message>
    <message>
      <source>Strut radius, mm</source>
      <translation>Raggio delle aste, mm</translation>
    </message>
    <message>
      <source>Temperature</source>
      <translation>Temperatura</translation>
    </message>
    <message>
      <source>Temperature, °C</source>
      <translation>Temperatura, °C</translation>
    </message>
    <message>
      <source>The lattice is not the one that was sized any more: size it again.</source>
      <translation>Il reticolo non è più quello dimensionato: dimensionarlo di nuovo.</translation>
    </message>
    <message>
      <source>The skin was not sized: Loads and Sizing does that with a thinnest skin.</source>
      <translation>Il guscio non è stato dimensionato: Carichi e dimensionamento lo fa con un guscio minimo.</translation>
    </message>
    <message>
      <source>What governs is not kept in the document: Loads and Sizing puts it there.</source>
      <translation>Nel documento non è indicato il limite determinante: Carichi e dimensionamento ve lo scrive.</translation>
    </message>
    <message>
      <source>automatic: {factor:g} ×</source>
      <translation>automatico: {factor:g} ×</translation>
    </message>
    <message>
      <source>from</source>
      <translation>da</translation>
    </message>
    <message>
      <source>to</source>
      <translation>a</translation>
    </message>
    <message>
      <source>{value} under the mouse</source>
      <translation>{value} sotto il mouse</translation>
    </message>
  </context>
  <context>
    <name>VolfrepCommands</name>
    <message>
      <source>'{label}' is a closed surface and not a solid yet: convert it (Part &gt; Convert to solid).</source>
      <translation>'{label}' è una superficie chiusa e non ancora un solido: convertirla (Part &gt; Converti in solido).</translation>
    </message>
    <message>
      <source>'{label}' is an open surface, which encloses nothing: close it or give it a thickness, and convert it to a solid (Part &gt; Convert to solid).</source>
      <translation>'{label}' è una superficie aperta, che non racchiude nulla: chiuderla o darle uno spessore, e convertirla in un solido (Part &gt; Converti in solido).</translation>
    </message>
    <message>
      <source>A panel is open: end it first.</source>
      <translation>È aperto un pannello: chiuderlo prima.</translation>
    </message>
    <message>
      <source>Analyse '{label}' with:</source>
      <translation>Analizza '{label}' con:</translation>
    </message>
    <message>
      <source>Check Mesh: {label}</source>
      <translation>Controlla mesh: {label}</translation>
    </message>
    <message>
      <source>Edge of a pixel</source>
      <translation>Lato di un pixel</translation>
    </message>
    <message>
      <source>Export Layers</source>
      <translation>Esporta strati</translation>
    </message>
    <message>
      <source>Fill {count} solids, each with cells that suit its size? A single one opens the panel.</source>
      <translation>Riempire {count} solidi, ognuno con celle adatte alla sua misura? Uno solo apre il pannello.</translation>
    </message>
    <message>
      <source>Height of a layer</source>
      <translation>Altezza di uno strato</translation>
    </message>
    <message>
      <source>Make of '{label}':</source>
      <translation>Ricava da '{label}':</translation>
    </message>
    <message>
      <source>Mesh of {label}</source>
      <translation>Mesh di {label}</translation>
    </message>
    <message>
      <source>Select one lattice infill and, with Ctrl, faces of its solid.</source>
      <translation>Selezionare un riempimento reticolare e, con Ctrl, facce del suo solido.</translation>
    </message>
    <message>
      <source>Select one lattice infill or one design study.</source>
      <translation>Selezionare un riempimento reticolare o uno studio di varianti.</translation>
    </message>
    <message>
      <source>Select one lattice infill that has a solid, or one solid, with its 3D view in front.</source>
      <translation>Selezionare un riempimento reticolare che ha un solido, o un solido, con la sua vista 3D in primo piano.</translation>
    </message>
    <message>
      <source>Select one lattice infill that has a solid, with its 3D view in front.</source>
      <translation>Selezionare un riempimento reticolare che ha un solido, con la sua vista 3D in primo piano.</translation>
    </message>
    <message>
      <source>Select one lattice infill that is computed, or one mesh.</source>
      <translation>Selezionare un riempimento reticolare calcolato, o una mesh.</translation>
    </message>
    <message>
      <source>Select one lattice infill that is computed, with its 3D view in front.</source>
      <translation>Selezionare un riempimento reticolare calcolato, con la sua vista 3D in primo piano.</translation>
    </message>
    <message>
      <source>Select one lattice infill.</source>
      <translation>Selezionare un riempimento reticolare.</translation>
    </message>
    <message>
      <source>Select one or more solids: a Body, a Part, a link to one, a closed mesh.</source>
      <translation>Selezionare uno o più solidi: un Corpo, una Parte, un collegamento, una mesh chiusa.</translation>
    </message>
    <message>
      <source>Select one solid, with Ctrl a FEM result or sized lattice infill, or one slicer infill.</source>
      <translation>Selezionare un solido, con Ctrl anche un risultato FEM o un riempimento reticolare dimensionato, oppure un riempimento per slicer.</translation>
    </message>
    <message>
      <source>There is no lattice infill in this document: make one first.</source>
      <translation>In questo documento non c'è un riempimento reticolare: crearne prima uno.</translation>
    </message>
    <message>
      <source>beams</source>
      <translation>travi</translation>
    </message>
    <message>
      <source>tetrahedra</source>
      <translation>tetraedri</translation>
    </message>
    <message>
      <source>{file}: {estimate}. Write it?</source>
      <translation>{file}: {estimate}. Scriverlo?</translation>
    </message>
    <message>
      <source>{label} is up to date</source>
      <translation>{label} è aggiornato</translation>
    </message>
    <message>
      <source>{label}: preview off</source>
      <translation>{label}: anteprima tolta</translation>
    </message>
    <message>
      <source>{label}: preview shown, figures in the report view</source>
      <translation>{label}: anteprima mostrata, dati nella vista report</translation>
    </message>
  </context>
  <context>
    <name>VolfrepCoupons</name>
    <message>
      <source>Bar with grips, for tension</source>
      <translation>Barra con afferraggi, per trazione</translation>
    </message>
    <message>
      <source>Beam, for bending on three points</source>
      <translation>Trave, per flessione su tre punti</translation>
    </message>
    <message>
      <source>Cells along the cube</source>
      <translation>Celle lungo il cubo</translation>
    </message>
    <message>
      <source>Cube between plates, for compression</source>
      <translation>Cubo fra piastre, per compressione</translation>
    </message>
    <message>
      <source>Folder for STL files</source>
      <translation>Cartella per file STL</translation>
    </message>
    <message>
      <source>Ladder of struts, whose diameters are measured</source>
      <translation>Scala di aste, i cui diametri si misurano</translation>
    </message>
    <message>
      <source>Number of the first</source>
      <translation>Numero del primo</translation>
    </message>
    <message>
      <source>none: into the document only</source>
      <translation>nessuna: solo nel documento</translation>
    </message>
  </context>
  <context>
    <name>VolfrepCurve</name>
    <message>
      <source>Curve: {name}</source>
      <translation>Curva: {name}</translation>
    </message>
    <message>
      <source>Drag a point; double click for a new one, right click to remove one. Keys: Page Up and Down choose a point, arrows move it, Insert and Delete add and remove.</source>
      <translation>Trascinare un punto; doppio clic per aggiungerne uno, clic destro per toglierne uno. Tasti: Pag su e giù scelgono un punto, le frecce lo spostano, Ins e Canc aggiungono e tolgono.</translation>
    </message>
    <message>
      <source>Falling</source>
      <translation>Discendente</translation>
    </message>
    <message>
      <source>Rising</source>
      <translation>Ascendente</translation>
    </message>
    <message>
      <source>Shape of the curve</source>
      <translation>Forma della curva</translation>
    </message>
    <message>
      <source>Shape...</source>
      <translation>Forma...</translation>
    </message>
    <message>
      <source>Step</source>
      <translation>Gradino</translation>
    </message>
    <message>
      <source>Thick at the ends</source>
      <translation>Spesso alle estremità</translation>
    </message>
    <message>
      <source>Thick in the middle</source>
      <translation>Spesso al centro</translation>
    </message>
  </context>
  <context>
    <name>VolfrepFigures</name>
    <message>
      <source>Choose a process to see its limits.</source>
      <translation>Scegliere un processo per vederne i limiti.</translation>
    </message>
    <message>
      <source>Told by Print Check, once computed.</source>
      <translation>Lo dice il controllo di stampa, dopo il calcolo.</translation>
    </message>
    <message>
      <source>a closed skin</source>
      <translation>guscio chiuso</translation>
    </message>
    <message>
      <source>at least {limit}</source>
      <translation>almeno {limit}</translation>
    </message>
    <message>
      <source>at most {limit}</source>
      <translation>al massimo {limit}</translation>
    </message>
    <message>
      <source>closed voids</source>
      <translation>vuoti chiusi</translation>
    </message>
    <message>
      <source>cost of the material</source>
      <translation>costo del materiale</translation>
    </message>
    <message>
      <source>longest flat strut</source>
      <translation>asta piana più lunga</translation>
    </message>
    <message>
      <source>narrowest gap</source>
      <translation>spazio più stretto</translation>
    </message>
    <message>
      <source>none</source>
      <translation>nessuno</translation>
    </message>
    <message>
      <source>offset {radius} mm</source>
      <translation>scostamento {radius} mm</translation>
    </message>
    <message>
      <source>over {width} mm</source>
      <translation>oltre {width} mm</translation>
    </message>
    <message>
      <source>saved against the solid</source>
      <translation>risparmio rispetto al pieno</translation>
    </message>
    <message>
      <source>strut radius {radius} mm</source>
      <translation>raggio delle aste {radius} mm</translation>
    </message>
    <message>
      <source>struts below {angle}°</source>
      <translation>aste sotto {angle}°</translation>
    </message>
    <message>
      <source>thickness {radius} mm</source>
      <translation>spessore {radius} mm</translation>
    </message>
    <message>
      <source>thinnest strut</source>
      <translation>asta più sottile</translation>
    </message>
    <message>
      <source>varies: see Print Check</source>
      <translation>varia: vedere il controllo di stampa</translation>
    </message>
    <message>
      <source>{mass} g, {triangles} triangles, made in {seconds} s</source>
      <translation>{mass} g, {triangles} triangoli, creata in {seconds} s</translation>
    </message>
    <message>
      <source>{number} active cells</source>
      <translation>{number} celle attive</translation>
    </message>
    <message>
      <source>{number} struts</source>
      <translation>{number} aste</translation>
    </message>
    <message>
      <source>{voids}, holding {volume} cm³</source>
      <translation>{voids} con {volume} cm³</translation>
    </message>
    <message>
      <source>{what}
relative density {density} %, mass {mass} g
about {triangles} triangles, {size} MB as STL, {seconds} s to compute</source>
      <translation>{what}
densità relativa {density} %, massa {mass} g
circa {triangles} triangoli, {size} MB come STL, {seconds} s di calcolo</translation>
    </message>
  </context>
  <context>
    <name>VolfrepFinder</name>
    <message>
      <source>Density</source>
      <translation>Densità</translation>
    </message>
    <message>
      <source>Find Cells</source>
      <translation>Trova celle</translation>
    </message>
    <message>
      <source>Modulus</source>
      <translation>Modulo</translation>
    </message>
    <message>
      <source>No cell of the library has that: ask for something else.</source>
      <translation>Nessuna cella della libreria ha ciò: chiedere altro.</translation>
    </message>
    <message>
      <source>along</source>
      <translation>lungo</translation>
    </message>
    <message>
      <source>any: moduli over the solid's</source>
      <translation>qualsiasi: moduli su quello del solido</translation>
    </message>
    <message>
      <source>cell</source>
      <translation>cella</translation>
    </message>
    <message>
      <source>density, %</source>
      <translation>densità, %</translation>
    </message>
    <message>
      <source>least strength</source>
      <translation>resistenza minima</translation>
    </message>
    <message>
      <source>least strength, MPa</source>
      <translation>resistenza minima, MPa</translation>
    </message>
    <message>
      <source>modulus</source>
      <translation>modulo</translation>
    </message>
    <message>
      <source>modulus over the solid's</source>
      <translation>modulo su quello del solido</translation>
    </message>
    <message>
      <source>modulus, MPa</source>
      <translation>modulo, MPa</translation>
    </message>
    <message>
      <source>of</source>
      <translation>di</translation>
    </message>
    <message>
      <source>r, mm</source>
      <translation>r, mm</translation>
    </message>
    <message>
      <source>relative density</source>
      <translation>densità relativa</translation>
    </message>
    <message>
      <source>{count} cells, with L = {size} mm</source>
      <translation>{count} celle, con L = {size} mm</translation>
    </message>
  </context>
  <context>
    <name>VolfrepFormats</name>
    <message>
      <source>3MF</source>
      <translation>3MF</translation>
    </message>
    <message>
      <source>3MF, beams only</source>
      <translation>3MF, solo travi</translation>
    </message>
    <message>
      <source>3MF, mesh and beams</source>
      <translation>3MF, mesh e travi</translation>
    </message>
    <message>
      <source>3MF, project for OrcaSlicer and Bambu Studio</source>
      <translation>3MF, progetto per OrcaSlicer e Bambu Studio</translation>
    </message>
    <message>
      <source>3MF, project for PrusaSlicer</source>
      <translation>3MF, progetto per PrusaSlicer</translation>
    </message>
    <message>
      <source>3MF, within limits or compensated</source>
      <translation>3MF, entro limiti o compensato</translation>
    </message>
    <message>
      <source>CalculiX, beams</source>
      <translation>CalculiX, travi</translation>
    </message>
    <message>
      <source>CalculiX, tetrahedra</source>
      <translation>CalculiX, tetraedri</translation>
    </message>
    <message>
      <source>GLB, for viewers</source>
      <translation>GLB, per i visualizzatori</translation>
    </message>
    <message>
      <source>Layers, common layer interface</source>
      <translation>Strati, Common Layer Interface</translation>
    </message>
    <message>
      <source>Layers, drawings</source>
      <translation>Strati, disegni</translation>
    </message>
    <message>
      <source>Layers, pictures for resin printers</source>
      <translation>Strati, immagini per stampanti a resina</translation>
    </message>
    <message>
      <source>OBJ</source>
      <translation>OBJ</translation>
    </message>
    <message>
      <source>OFF</source>
      <translation>OFF</translation>
    </message>
    <message>
      <source>PLY</source>
      <translation>PLY</translation>
    </message>
    <message>
      <source>STEP, axes of the struts</source>
      <translation>STEP, assi delle aste</translation>
    </message>
    <message>
      <source>STEP, exact surfaces</source>
      <translation>STEP, superfici esatte</translation>
    </message>
    <message>
      <source>STEP, instances of joints</source>
      <translation>STEP, istanze dei nodi</translation>
    </message>
    <message>
      <source>STEP, plane faces</source>
      <translation>STEP, facce piane</translation>
    </message>
    <message>
      <source>STL</source>
      <translation>STL</translation>
    </message>
    <message>
      <source>STL, within limits or compensated</source>
      <translation>STL, entro limiti o compensato</translation>
    </message>
  </context>
  <context>
    <name>VolfrepFreshness</name>
    <message>
      <source>Comes once the mesh is there</source>
      <translation>Viene quando la mesh c'è</translation>
    </message>
    <message>
      <source>Recompute first</source>
      <translation>Prima ricalcola</translation>
    </message>
    <message>
      <source>The mesh of {labels} is out of date: {why}.</source>
      <translation>La mesh di {labels} non è aggiornata: {why}.</translation>
    </message>
    <message>
      <source>Update</source>
      <translation>Aggiorna</translation>
    </message>
    <message>
      <source>Use it as it is</source>
      <translation>Usala com'è</translation>
    </message>
    <message>
      <source>its present values cannot be computed</source>
      <translation>i suoi valori attuali non si possono calcolare</translation>
    </message>
    <message>
      <source>values or the solid have changed since it was made</source>
      <translation>i valori o il solido sono cambiati da quando è stata fatta</translation>
    </message>
    <message>
      <source>what it is made of has changed and is not recomputed yet</source>
      <translation>ciò di cui è fatta è cambiato e non è ancora ricalcolato</translation>
    </message>
    <message>
      <source>{count} lattices are out of date</source>
      <translation>{count} reticoli non sono aggiornati</translation>
    </message>
    <message>
      <source>{label} is out of date</source>
      <translation>{label} non è aggiornato</translation>
    </message>
  </context>
  <context>
    <name>VolfrepHelp</name>
    <message>
      <source>Back</source>
      <translation>Indietro</translation>
    </message>
    <message>
      <source>Contents</source>
      <translation>Indice</translation>
    </message>
  </context>
  <context>
    <name>VolfrepInstall</name>
    <message>
      <source>&amp;Copy Command</source>
      <translation>&amp;Copia il comando</translation>
    </message>
    <message>
      <source>&amp;Install</source>
      <translation>&amp;Installa</translation>
    </message>
    <message>
      <source>All packages are there: go on.</source>
      <translation>Tutti i pacchetti ci sono: si può continuare.</translation>
    </message>
    <message>
      <source>All packages are there: restart FreeCAD.</source>
      <translation>Tutti i pacchetti sono presenti: riavviare FreeCAD.</translation>
    </message>
    <message>
      <source>C&amp;lose</source>
      <translation>C&amp;hiudi</translation>
    </message>
    <message>
      <source>Installing...</source>
      <translation>Installazione...</translation>
    </message>
    <message>
      <source>Packages for VOLFREP</source>
      <translation>Pacchetti per VOLFREP</translation>
    </message>
    <message>
      <source>The command is on the clipboard: run it, then restart FreeCAD.</source>
      <translation>Il comando è negli appunti: eseguirlo, poi riavviare FreeCAD.</translation>
    </message>
    <message>
      <source>VOLFREP needs the Python packages {names}. Install puts them into FreeCAD's own folder {folder}, and nowhere else; it takes a connection to the internet and about a minute.</source>
      <translation>VOLFREP ha bisogno dei pacchetti Python {names}. Installa li mette nella cartella propria di FreeCAD {folder} e in nessun'altra; servono una connessione a Internet e circa un minuto.</translation>
    </message>
    <message>
      <source>What the installation says</source>
      <translation>Che cosa dice l'installazione</translation>
    </message>
    <message>
      <source>{names} could not be installed: read below why. The command can be copied and run elsewhere.</source>
      <translation>{names}: installazione non riuscita, il perché è scritto sotto. Il comando si può copiare ed eseguire altrove.</translation>
    </message>
    <message>
      <source>{names} is not on FreeCAD's list of allowed packages, so Install leaves it out; the command below has it. Some parts cannot be made without it.</source>
      <translation>{names} non è nell'elenco dei pacchetti ammessi da FreeCAD, perciò Installa lo tralascia; il comando qui sotto lo comprende. Alcuni pezzi non si possono realizzare senza.</translation>
    </message>
  </context>
  <context>
    <name>VolfrepJobs</name>
    <message>
      <source>Beams of {label}</source>
      <translation>Travi di {label}</translation>
    </message>
    <message>
      <source>Build direction of {label}</source>
      <translation>Direzione di costruzione di {label}</translation>
    </message>
    <message>
      <source>Checking {label}</source>
      <translation>Controllo di {label}</translation>
    </message>
    <message>
      <source>Colours of {label}</source>
      <translation>Colori di {label}</translation>
    </message>
    <message>
      <source>Coupons of {label}</source>
      <translation>Provini di {label}</translation>
    </message>
    <message>
      <source>Exact surfaces of {label}</source>
      <translation>Superfici esatte di {label}</translation>
    </message>
    <message>
      <source>FEM analysis of {label}</source>
      <translation>Analisi FEM di {label}</translation>
    </message>
    <message>
      <source>File of {label}</source>
      <translation>File di {label}</translation>
    </message>
    <message>
      <source>Filling {label}</source>
      <translation>Riempimento di {label}</translation>
    </message>
    <message>
      <source>Heat in {label}</source>
      <translation>Calore in {label}</translation>
    </message>
    <message>
      <source>Infill bands of {label}</source>
      <translation>Bande di riempimento di {label}</translation>
    </message>
    <message>
      <source>Instances of {label}</source>
      <translation>Istanze di {label}</translation>
    </message>
    <message>
      <source>Layers of {label}</source>
      <translation>Strati di {label}</translation>
    </message>
    <message>
      <source>Plane faces of {label}</source>
      <translation>Facce piane di {label}</translation>
    </message>
    <message>
      <source>Print check of {label}</source>
      <translation>Controllo di stampa di {label}</translation>
    </message>
    <message>
      <source>Properties of the lattice of {label}</source>
      <translation>Proprietà del reticolo di {label}</translation>
    </message>
    <message>
      <source>Sizing {label}</source>
      <translation>Dimensionamento di {label}</translation>
    </message>
    <message>
      <source>Struts of {label}</source>
      <translation>Aste di {label}</translation>
    </message>
    <message>
      <source>Studying {label}</source>
      <translation>Studio di {label}</translation>
    </message>
    <message>
      <source>Tetrahedra of {label}</source>
      <translation>Tetraedri di {label}</translation>
    </message>
    <message>
      <source>Writing {label}</source>
      <translation>Scrittura di {label}</translation>
    </message>
  </context>
  <context>
    <name>VolfrepLabels</name>
    <message>
      <source>{label} analysis</source>
      <translation>{label} analisi</translation>
    </message>
    <message>
      <source>{label} axes</source>
      <translation>{label} assi</translation>
    </message>
    <message>
      <source>{label} coupons</source>
      <translation>{label} provini</translation>
    </message>
    <message>
      <source>{label} infill</source>
      <translation>{label} riempimento</translation>
    </message>
    <message>
      <source>{label} instances</source>
      <translation>{label} istanze</translation>
    </message>
    <message>
      <source>{label} lattice</source>
      <translation>{label} reticolo</translation>
    </message>
    <message>
      <source>{label} print check</source>
      <translation>{label} controllo di stampa</translation>
    </message>
    <message>
      <source>{label} solid</source>
      <translation>{label} solido</translation>
    </message>
    <message>
      <source>{label} study</source>
      <translation>{label} studio</translation>
    </message>
  </context>
  <context>
    <name>VolfrepLoads</name>
    <message>
      <source>Another case, held as this one is</source>
      <translation>Un altro caso, vincolato come questo</translation>
    </message>
    <message>
      <source>Click at faces in the view that carry the force; Ctrl takes all alike</source>
      <translation>Fare clic nella vista sulle facce che portano la forza; Ctrl prende tutte le uguali</translation>
    </message>
    <message>
      <source>Click at faces in the view that do not move; Ctrl takes all alike</source>
      <translation>Fare clic nella vista sulle facce che non si muovono; Ctrl prende tutte le uguali</translation>
    </message>
    <message>
      <source>Click at faces in the view that have this temperature; Ctrl takes all alike</source>
      <translation>Fare clic nella vista sulle facce che hanno questa temperatura; Ctrl prende tutte quelle uguali</translation>
    </message>
    <message>
      <source>Click at faces in the view through which this heat flows in; below 0, out</source>
      <translation>Fare clic nella vista sulle facce da cui entra questo calore; sotto 0, esce</translation>
    </message>
    <message>
      <source>Click at faces in the view under pressure; Ctrl takes all alike</source>
      <translation>Fare clic nella vista sulle facce sotto pressione; Ctrl prende tutte le uguali</translation>
    </message>
    <message>
      <source>Direction</source>
      <translation>Direzione</translation>
    </message>
    <message>
      <source>Force</source>
      <translation>Forza</translation>
    </message>
    <message>
      <source>Heat flow</source>
      <translation>Flusso di calore</translation>
    </message>
    <message>
      <source>Held</source>
      <translation>Vincolo</translation>
    </message>
    <message>
      <source>Load case {number}</source>
      <translation>Caso di carico {number}</translation>
    </message>
    <message>
      <source>New case</source>
      <translation>Nuovo caso</translation>
    </message>
    <message>
      <source>Pressure</source>
      <translation>Pressione</translation>
    </message>
    <message>
      <source>Remove</source>
      <translation>Togliere</translation>
    </message>
    <message>
      <source>Size</source>
      <translation>Valore</translation>
    </message>
    <message>
      <source>Temperature</source>
      <translation>Temperatura</translation>
    </message>
    <message>
      <source>The part's own weight, downwards</source>
      <translation>Il peso proprio del pezzo, verso il basso</translation>
    </message>
    <message>
      <source>Weight</source>
      <translation>Peso</translation>
    </message>
    <message>
      <source>into the face</source>
      <translation>nella faccia</translation>
    </message>
    <message>
      <source>out of the face</source>
      <translation>fuori dalla faccia</translation>
    </message>
  </context>
  <context>
    <name>VolfrepMessages</name>
    <message>
      <source>Cancelled.</source>
      <translation>Annullato.</translation>
    </message>
    <message>
      <source>{path} written</source>
      <translation>{path} scritto</translation>
    </message>
  </context>
  <context>
    <name>VolfrepNumbers</name>
    <message>
      <source>,</source>
      <translation>.</translation>
    </message>
    <message>
      <source>.</source>
      <translation>,</translation>
    </message>
  </context>
  <context>
    <name>VolfrepOrient</name>
    <message>
      <source>Least cost first: overhang, supports, height, footprint off the plate</source>
      <translation>Prima il costo minore: sbalzo, supporti, altezza, impronta non sul piano</translation>
    </message>
    <message>
      <source>Needs support below</source>
      <translation>Richiede supporti sotto</translation>
    </message>
    <message>
      <source>Set Build Direction</source>
      <translation>Imposta direzione di costruzione</translation>
    </message>
    <message>
      <source>The part stays; its print checks look along this direction</source>
      <translation>Il pezzo resta; le sue verifiche di stampa guardano lungo questa direzione</translation>
    </message>
    <message>
      <source>Turn Part</source>
      <translation>Ruota il pezzo</translation>
    </message>
    <message>
      <source>Turned: z is up, and it stands on z = 0.</source>
      <translation>Ruotato: z è in alto, e poggia su z = 0.</translation>
    </message>
    <message>
      <source>cost</source>
      <translation>costo</translation>
    </message>
    <message>
      <source>height</source>
      <translation>altezza</translation>
    </message>
    <message>
      <source>now</source>
      <translation>ora</translation>
    </message>
    <message>
      <source>overhang</source>
      <translation>sbalzo</translation>
    </message>
    <message>
      <source>up: {up}
{inside} mm² of the overhang in closed rooms; supports at most {support} mm³; stands on {base} mm², footprint {footprint} mm²</source>
      <translation>su: {up}
{inside} mm² dello sbalzo in vani chiusi; supporti al massimo {support} mm³; poggia su {base} mm², impronta {footprint} mm²</translation>
    </message>
    <message>
      <source>{checks}: built along it.</source>
      <translation>{checks}: costruito lungo di essa.</translation>
    </message>
  </context>
  <context>
    <name>VolfrepPreferences</name>
    <message>
      <source>A change that comes to more triangles waits for Update Lattice Infill</source>
      <translation>Una modifica che comporta più triangoli attende Aggiorna riempimento reticolare</translation>
    </message>
    <message>
      <source>A mesh of more triangles is shown by a coarse likeness; files stay full</source>
      <translation>Una mesh con più triangoli è mostrata in forma grossolana; i file restano completi</translation>
    </message>
    <message>
      <source>Cell size</source>
      <translation>Dimensione cella</translation>
    </message>
    <message>
      <source>Cell type</source>
      <translation>Tipo di cella</translation>
    </message>
    <message>
      <source>Colour of cut faces</source>
      <translation>Colore delle facce tagliate</translation>
    </message>
    <message>
      <source>Colour of overhangs</source>
      <translation>Colore degli sbalzi</translation>
    </message>
    <message>
      <source>Colour of the lattice</source>
      <translation>Colore del reticolo</translation>
    </message>
    <message>
      <source>Colour of the skin</source>
      <translation>Colore del guscio</translation>
    </message>
    <message>
      <source>Defaults</source>
      <translation>Predefiniti</translation>
    </message>
    <message>
      <source>Density</source>
      <translation>Densità</translation>
    </message>
    <message>
      <source>Density of the material, from which the mass comes</source>
      <translation>Densità del materiale, da cui deriva la massa</translation>
    </message>
    <message>
      <source>Deviation</source>
      <translation>Scostamento</translation>
    </message>
    <message>
      <source>Display</source>
      <translation>Visualizzazione</translation>
    </message>
    <message>
      <source>Display and limits</source>
      <translation>Visualizzazione e limiti</translation>
    </message>
    <message>
      <source>Distance between a facet and the exact strut, where the resolution is automatic; automatic: by the strut radius</source>
      <translation>Distanza tra una faccetta e l'asta esatta, con la risoluzione automatica; automatica: secondo il raggio dell'asta</translation>
    </message>
    <message>
      <source>Edge length L of a cell; automatic: about four cells across the thinnest side of the part</source>
      <translation>Lunghezza L dello spigolo di una cella; automatica: circa quattro celle sul lato più sottile della parte</translation>
    </message>
    <message>
      <source>Facets along the edge of a cell; automatic: chosen by the deviation</source>
      <translation>Faccette lungo lo spigolo di una cella; automatico: scelte in base allo scostamento</translation>
    </message>
    <message>
      <source>For searching nearest points, measuring meshes and writing STL files, and at most so many processes that fill a part; automatic: one on each core</source>
      <translation>Per cercare i punti più vicini, misurare mesh e scrivere file STL, e al massimo altrettanti processi per riempire un pezzo; automatico: uno per ogni core</translation>
    </message>
    <message>
      <source>In Section View</source>
      <translation>Nella vista in sezione</translation>
    </message>
    <message>
      <source>Lattice</source>
      <translation>Reticolo</translation>
    </message>
    <message>
      <source>Limits</source>
      <translation>Limiti</translation>
    </message>
    <message>
      <source>Material</source>
      <translation>Materiale</translation>
    </message>
    <message>
      <source>Mesh</source>
      <translation>Mesh</translation>
    </message>
    <message>
      <source>More struts than these are drawn as lines, in the preview and in the display mode Simplified</source>
      <translation>Oltre questo numero le aste sono disegnate come linee, nell'anteprima e nel modo di visualizzazione Simplified</translation>
    </message>
    <message>
      <source>New infill</source>
      <translation>Nuovo riempimento</translation>
    </message>
    <message>
      <source>Of a new infill</source>
      <translation>Di un nuovo riempimento</translation>
    </message>
    <message>
      <source>Of a new infill, so that the lattice is seen through the skin</source>
      <translation>Di un nuovo riempimento, perché il reticolo si veda attraverso il guscio</translation>
    </message>
    <message>
      <source>Of a new print check</source>
      <translation>Di un nuovo controllo di stampa</translation>
    </message>
    <message>
      <source>Of the material, in your currency, from which the panel tells the cost; 0: no cost is told</source>
      <translation>Del materiale, nella propria valuta, da cui il pannello dice il costo; 0: nessun costo</translation>
    </message>
    <message>
      <source>Price of a kilogram</source>
      <translation>Prezzo di un chilogrammo</translation>
    </message>
    <message>
      <source>Radius of the struts as a share of the cell size L</source>
      <translation>Raggio delle aste come frazione della dimensione L della cella</translation>
    </message>
    <message>
      <source>Resolution</source>
      <translation>Risoluzione</translation>
    </message>
    <message>
      <source>Show the values that VOLFREP comes with</source>
      <translation>Mostra i valori originali di VOLFREP</translation>
    </message>
    <message>
      <source>Skin thickness</source>
      <translation>Spessore del guscio</translation>
    </message>
    <message>
      <source>Strut radius</source>
      <translation>Raggio delle aste</translation>
    </message>
    <message>
      <source>Struts to show as solids</source>
      <translation>Aste da mostrare come solidi</translation>
    </message>
    <message>
      <source>The property AutoUpdate of a new infill; without it, use Update Lattice Infill</source>
      <translation>La proprietà AutoUpdate di un nuovo riempimento; senza, si usa Aggiorna riempimento reticolare</translation>
    </message>
    <message>
      <source>The unit cell of a new infill</source>
      <translation>La cella unitaria di un nuovo riempimento</translation>
    </message>
    <message>
      <source>Thickness of the closed skin; automatic: a fifth of the cell size</source>
      <translation>Spessore del guscio chiuso; automatico: un quinto della dimensione della cella</translation>
    </message>
    <message>
      <source>Threads</source>
      <translation>Thread</translation>
    </message>
    <message>
      <source>Transparency</source>
      <translation>Trasparenza</translation>
    </message>
    <message>
      <source>Triangles to show</source>
      <translation>Triangoli da mostrare</translation>
    </message>
    <message>
      <source>Triangles to wait at</source>
      <translation>Triangoli oltre i quali attendere</translation>
    </message>
    <message>
      <source>Update at every change</source>
      <translation>Aggiorna a ogni modifica</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatico</translation>
    </message>
  </context>
  <context>
    <name>VolfrepPrinterFile</name>
    <message>
      <source>As drawn</source>
      <translation>Come disegnato</translation>
    </message>
    <message>
      <source>Diameters: {source}. Yours may differ: print coupons.</source>
      <translation>Diametri: {source}. I vostri possono differire: stampate provini.</translation>
    </message>
    <message>
      <source>Drawn for the printer</source>
      <translation>Disegnato per la stampante</translation>
    </message>
    <message>
      <source>Largest file</source>
      <translation>File più grande</translation>
    </message>
    <message>
      <source>Limits: {source}, read {date}; they may have changed.</source>
      <translation>Limiti: {source}, letti {date}; possono essere cambiati.</translation>
    </message>
    <message>
      <source>Measured diameters (*.csv)</source>
      <translation>Diametri misurati (*.csv)</translation>
    </message>
    <message>
      <source>Most triangles</source>
      <translation>Triangoli al massimo</translation>
    </message>
    <message>
      <source>My own limits</source>
      <translation>Limiti propri</translation>
    </message>
    <message>
      <source>My own measurements</source>
      <translation>Misure proprie</translation>
    </message>
    <message>
      <source>Service</source>
      <translation>Servizio</translation>
    </message>
    <message>
      <source>Table</source>
      <translation>Tabella</translation>
    </message>
    <message>
      <source>The mesh has {triangles} triangles, {size} MB as STL.</source>
      <translation>La mesh ha {triangles} triangoli, {size} MB come STL.</translation>
    </message>
    <message>
      <source>no limit</source>
      <translation>nessun limite</translation>
    </message>
    <message>
      <source>{count} triangles</source>
      <translation>{count} triangoli</translation>
    </message>
  </context>
  <context>
    <name>VolfrepProgress</name>
    <message>
      <source>Cancel</source>
      <translation>Annulla</translation>
    </message>
    <message>
      <source>Cancelling...</source>
      <translation>Annullamento...</translation>
    </message>
    <message>
      <source>Stop this job (Esc)</source>
      <translation>Interrompi questo lavoro (Esc)</translation>
    </message>
    <message>
      <source>check</source>
      <translation>controllo</translation>
    </message>
    <message>
      <source>crossings</source>
      <translation>intersezioni</translation>
    </message>
    <message>
      <source>into the document when you pause</source>
      <translation>nel documento alla prima pausa</translation>
    </message>
    <message>
      <source>lattice</source>
      <translation>reticolo</translation>
    </message>
    <message>
      <source>proof</source>
      <translation>verifica</translation>
    </message>
    <message>
      <source>shell</source>
      <translation>guscio</translation>
    </message>
    <message>
      <source>sizing</source>
      <translation>dimensionamento</translation>
    </message>
    <message>
      <source>skin</source>
      <translation>guscio</translation>
    </message>
    <message>
      <source>tile</source>
      <translation>tassello</translation>
    </message>
    <message>
      <source>trim</source>
      <translation>taglio</translation>
    </message>
    <message>
      <source>voxels</source>
      <translation>voxel</translation>
    </message>
    <message>
      <source>waiting</source>
      <translation>in attesa</translation>
    </message>
    <message>
      <source>write</source>
      <translation>scrittura</translation>
    </message>
    <message>
      <source>{done} of {runs} runs, about {time} left</source>
      <translation>{done} esecuzioni su {runs}, ancora circa {time}</translation>
    </message>
  </context>
  <context>
    <name>VolfrepRecipes</name>
    <message>
      <source>Bone-like</source>
      <translation>Simile all'osso</translation>
    </message>
    <message>
      <source>Cushion</source>
      <translation>Cuscino</translation>
    </message>
    <message>
      <source>Heat sink</source>
      <translation>Dissipatore</translation>
    </message>
    <message>
      <source>Keep these settings under a name, for other solids and documents</source>
      <translation>Conservare queste impostazioni sotto un nome, per altri solidi e documenti</translation>
    </message>
    <message>
      <source>Light bracket, LPBF</source>
      <translation>Staffa leggera, LPBF</translation>
    </message>
    <message>
      <source>Name of these settings:</source>
      <translation>Nome di queste impostazioni:</translation>
    </message>
    <message>
      <source>Recipe</source>
      <translation>Ricetta</translation>
    </message>
    <message>
      <source>Recipe...</source>
      <translation>Ricetta...</translation>
    </message>
    <message>
      <source>Save Recipe</source>
      <translation>Salva ricetta</translation>
    </message>
    <message>
      <source>Save...</source>
      <translation>Salva...</translation>
    </message>
    <message>
      <source>Start from named settings: VOLFREP's own, and those that you have saved</source>
      <translation>Partire da impostazioni con un nome: quelle di VOLFREP e quelle salvate</translation>
    </message>
  </context>
  <context>
    <name>VolfrepReport</name>
    <message>
      <source>Close</source>
      <translation>Chiudi</translation>
    </message>
    <message>
      <source>Copy</source>
      <translation>Copia</translation>
    </message>
    <message>
      <source>Domain</source>
      <translation>Dominio</translation>
    </message>
    <message>
      <source>E along [100]</source>
      <translation>E lungo [100]</translation>
    </message>
    <message>
      <source>E along [110]</source>
      <translation>E lungo [110]</translation>
    </message>
    <message>
      <source>E along [111]</source>
      <translation>E lungo [111]</translation>
    </message>
    <message>
      <source>E along x</source>
      <translation>E lungo x</translation>
    </message>
    <message>
      <source>E along y</source>
      <translation>E lungo y</translation>
    </message>
    <message>
      <source>E along z</source>
      <translation>E lungo z</translation>
    </message>
    <message>
      <source>For printing</source>
      <translation>Per la stampa</translation>
    </message>
    <message>
      <source>FreeCAD's own checks</source>
      <translation>Controlli di FreeCAD</translation>
    </message>
    <message>
      <source>Inputs</source>
      <translation>Dati</translation>
    </message>
    <message>
      <source>Lattice</source>
      <translation>Reticolo</translation>
    </message>
    <message>
      <source>Limits</source>
      <translation>Limiti</translation>
    </message>
    <message>
      <source>Mass</source>
      <translation>Massa</translation>
    </message>
    <message>
      <source>Notes</source>
      <translation>Note</translation>
    </message>
    <message>
      <source>Part</source>
      <translation>Parte</translation>
    </message>
    <message>
      <source>Peak memory at the end of each stage, MB</source>
      <translation>Memoria massima alla fine di ogni fase, MB</translation>
    </message>
    <message>
      <source>Poisson's ratio</source>
      <translation>coefficiente di Poisson</translation>
    </message>
    <message>
      <source>Result of the last update</source>
      <translation>Risultato dell'ultimo aggiornamento</translation>
    </message>
    <message>
      <source>Save Report</source>
      <translation>Salva rapporto</translation>
    </message>
    <message>
      <source>Save...</source>
      <translation>Salva...</translation>
    </message>
    <message>
      <source>Seconds by stage</source>
      <translation>Secondi per fase</translation>
    </message>
    <message>
      <source>Skin</source>
      <translation>Guscio</translation>
    </message>
    <message>
      <source>Steps</source>
      <translation>Passi</translation>
    </message>
    <message>
      <source>Struts</source>
      <translation>Aste</translation>
    </message>
    <message>
      <source>Surfaces that run through each other</source>
      <translation>Superfici che si attraversano</translation>
    </message>
    <message>
      <source>The same beams in CalculiX</source>
      <translation>Le stesse travi in CalculiX</translation>
    </message>
    <message>
      <source>The tables are on the clipboard.</source>
      <translation>Le tabelle sono negli appunti.</translation>
    </message>
    <message>
      <source>Triangles and the file's single precision</source>
      <translation>Triangoli e precisione singola del file</translation>
    </message>
    <message>
      <source>What the lattice does</source>
      <translation>Che cosa fa il reticolo</translation>
    </message>
    <message>
      <source>Zener anisotropy</source>
      <translation>anisotropia di Zener</translation>
    </message>
    <message>
      <source>a solid</source>
      <translation>un solido</translation>
    </message>
    <message>
      <source>active cells</source>
      <translation>celle attive</translation>
    </message>
    <message>
      <source>all</source>
      <translation>tutto</translation>
    </message>
    <message>
      <source>along lines through it</source>
      <translation>lungo linee che la attraversano</translation>
    </message>
    <message>
      <source>area</source>
      <translation>area</translation>
    </message>
    <message>
      <source>area, mm2</source>
      <translation>area, mm2</translation>
    </message>
    <message>
      <source>as a file holds it</source>
      <translation>come la conserva un file</translation>
    </message>
    <message>
      <source>beams say the most, solids may say the least</source>
      <translation>le travi dicono il massimo, i solidi forse il minimo</translation>
    </message>
    <message>
      <source>bodies</source>
      <translation>corpi</translation>
    </message>
    <message>
      <source>box</source>
      <translation>ingombro</translation>
    </message>
    <message>
      <source>buckling safety</source>
      <translation>sicurezza (instabilità)</translation>
    </message>
    <message>
      <source>buckling, % of its limit</source>
      <translation>instabilità, % del limite</translation>
    </message>
    <message>
      <source>build direction</source>
      <translation>direzione di costruzione</translation>
    </message>
    <message>
      <source>builds without support from, degrees</source>
      <translation>costruisce senza supporti da, gradi</translation>
    </message>
    <message>
      <source>bulk modulus</source>
      <translation>modulo di comprimibilità</translation>
    </message>
    <message>
      <source>cell</source>
      <translation>cella</translation>
    </message>
    <message>
      <source>cell size, mm</source>
      <translation>dimensione della cella, mm</translation>
    </message>
    <message>
      <source>cells of the grid</source>
      <translation>celle della griglia</translation>
    </message>
    <message>
      <source>check</source>
      <translation>controllo</translation>
    </message>
    <message>
      <source>closed</source>
      <translation>chiusa</translation>
    </message>
    <message>
      <source>closed voids</source>
      <translation>vuoti chiusi</translation>
    </message>
    <message>
      <source>conductivity</source>
      <translation>conducibilità</translation>
    </message>
    <message>
      <source>confirmed</source>
      <translation>confermato</translation>
    </message>
    <message>
      <source>corrupted triangles</source>
      <translation>triangoli corrotti</translation>
    </message>
    <message>
      <source>density</source>
      <translation>densità</translation>
    </message>
    <message>
      <source>density, g/cm3</source>
      <translation>densità, g/cm3</translation>
    </message>
    <message>
      <source>displacement, % of its limit</source>
      <translation>spostamento, % del limite</translation>
    </message>
    <message>
      <source>displacements differ by, %</source>
      <translation>gli spostamenti differiscono del, %</translation>
    </message>
    <message>
      <source>does not hold the limits</source>
      <translation>non rispetta i limiti</translation>
    </message>
    <message>
      <source>every place inside is enclosed once</source>
      <translation>ogni punto interno è racchiuso una volta</translation>
    </message>
    <message>
      <source>every triangle keeps its corners</source>
      <translation>ogni triangolo conserva i suoi vertici</translation>
    </message>
    <message>
      <source>flatter ceilings within the skin, mm2</source>
      <translation>soffitti più piatti entro il guscio, mm2</translation>
    </message>
    <message>
      <source>flatter parts of the outside, mm2</source>
      <translation>parti esterne più piatte, mm2</translation>
    </message>
    <message>
      <source>flatter struts removed</source>
      <translation>aste più piatte tolte</translation>
    </message>
    <message>
      <source>found</source>
      <translation>trovati</translation>
    </message>
    <message>
      <source>frame buckling, % of its limit</source>
      <translation>instabilità d'insieme, % del limite</translation>
    </message>
    <message>
      <source>frequency, % of its limit</source>
      <translation>frequenza, % del limite</translation>
    </message>
    <message>
      <source>from</source>
      <translation>da</translation>
    </message>
    <message>
      <source>genus</source>
      <translation>genere</translation>
    </message>
    <message>
      <source>governed by</source>
      <translation>limite determinante</translation>
    </message>
    <message>
      <source>invalid points</source>
      <translation>punti non validi</translation>
    </message>
    <message>
      <source>it has not solved this design</source>
      <translation>non ha risolto questo progetto</translation>
    </message>
    <message>
      <source>joints</source>
      <translation>nodi</translation>
    </message>
    <message>
      <source>largest displacement, mm</source>
      <translation>spostamento massimo, mm</translation>
    </message>
    <message>
      <source>largest radius, mm</source>
      <translation>raggio massimo, mm</translation>
    </message>
    <message>
      <source>largest stress of the skin, MPa</source>
      <translation>tensione massima del guscio, MPa</translation>
    </message>
    <message>
      <source>largest stress, CalculiX / VOLFREP</source>
      <translation>tensione massima, CalculiX / VOLFREP</translation>
    </message>
    <message>
      <source>largest stress, MPa</source>
      <translation>tensione massima, MPa</translation>
    </message>
    <message>
      <source>largest thickness, mm</source>
      <translation>spessore massimo, mm</translation>
    </message>
    <message>
      <source>lattice</source>
      <translation>reticolo</translation>
    </message>
    <message>
      <source>least strength along x, y, z</source>
      <translation>resistenza minima lungo x, y, z</translation>
    </message>
    <message>
      <source>limit</source>
      <translation>limite</translation>
    </message>
    <message>
      <source>load before struts buckle together, times</source>
      <translation>carico prima dell'instabilità d'insieme, volte</translation>
    </message>
    <message>
      <source>loose pieces removed</source>
      <translation>pezzi isolati rimossi</translation>
    </message>
    <message>
      <source>lowest frequency, CalculiX / VOLFREP</source>
      <translation>frequenza minima, CalculiX / VOLFREP</translation>
    </message>
    <message>
      <source>manifold</source>
      <translation>manifold</translation>
    </message>
    <message>
      <source>mass of the skin, g</source>
      <translation>massa del guscio, g</translation>
    </message>
    <message>
      <source>mass of the struts, g</source>
      <translation>massa delle aste, g</translation>
    </message>
    <message>
      <source>mass, g</source>
      <translation>massa, g</translation>
    </message>
    <message>
      <source>mean radius ratio</source>
      <translation>rapporto medio dei raggi</translation>
    </message>
    <message>
      <source>mean thickness, mm</source>
      <translation>spessore medio, mm</translation>
    </message>
    <message>
      <source>most</source>
      <translation>massimo</translation>
    </message>
    <message>
      <source>most stressed strut, at x, y, z</source>
      <translation>asta più sollecitata, in x, y, z</translation>
    </message>
    <message>
      <source>most used limit</source>
      <translation>limite più sfruttato</translation>
    </message>
    <message>
      <source>no</source>
      <translation>no</translation>
    </message>
    <message>
      <source>non-manifold edges or points</source>
      <translation>spigoli o punti non manifold</translation>
    </message>
    <message>
      <source>none</source>
      <translation>nessuno</translation>
    </message>
    <message>
      <source>not compared in CalculiX</source>
      <translation>non confrontato in CalculiX</translation>
    </message>
    <message>
      <source>of that solid, g</source>
      <translation>di cui pieno, g</translation>
    </message>
    <message>
      <source>on 90% of its area</source>
      <translation>sul 90% della sua area</translation>
    </message>
    <message>
      <source>on all but 0.1% of its area</source>
      <translation>su tutta l'area tranne lo 0,1%</translation>
    </message>
    <message>
      <source>one radius, as near as it gets</source>
      <translation>raggio unico, il più vicino possibile</translation>
    </message>
    <message>
      <source>one radius, one skin</source>
      <translation>raggio unico, guscio unico</translation>
    </message>
    <message>
      <source>one radius, same limits</source>
      <translation>raggio unico, stessi limiti</translation>
    </message>
    <message>
      <source>one radius, same mass</source>
      <translation>raggio unico, stessa massa</translation>
    </message>
    <message>
      <source>output</source>
      <translation>risultato</translation>
    </message>
    <message>
      <source>radius list</source>
      <translation>lista di raggi</translation>
    </message>
    <message>
      <source>radius, mm</source>
      <translation>raggio, mm</translation>
    </message>
    <message>
      <source>relative density</source>
      <translation>densità relativa</translation>
    </message>
    <message>
      <source>relative density, %</source>
      <translation>densità relativa, %</translation>
    </message>
    <message>
      <source>same mass, times as stiff as one radius</source>
      <translation>stessa massa, volte più rigido di un raggio unico</translation>
    </message>
    <message>
      <source>shear modulus</source>
      <translation>modulo di taglio</translation>
    </message>
    <message>
      <source>shear strength</source>
      <translation>resistenza al taglio</translation>
    </message>
    <message>
      <source>shell</source>
      <translation>guscio</translation>
    </message>
    <message>
      <source>short stubs removed</source>
      <translation>monconi corti rimossi</translation>
    </message>
    <message>
      <source>shortest and longest strut, mm</source>
      <translation>asta più corta e più lunga, mm</translation>
    </message>
    <message>
      <source>shortest edge</source>
      <translation>spigolo più corto</translation>
    </message>
    <message>
      <source>sized</source>
      <translation>dimensionato</translation>
    </message>
    <message>
      <source>skin stress, % of its limit</source>
      <translation>tensione del guscio, % del limite</translation>
    </message>
    <message>
      <source>skin, mm</source>
      <translation>guscio, mm</translation>
    </message>
    <message>
      <source>smallest and largest radius, mm</source>
      <translation>raggio minimo e massimo, mm</translation>
    </message>
    <message>
      <source>smallest angle</source>
      <translation>angolo minimo</translation>
    </message>
    <message>
      <source>smallest radius ratio</source>
      <translation>rapporto minimo dei raggi</translation>
    </message>
    <message>
      <source>smallest radius, mm</source>
      <translation>raggio minimo, mm</translation>
    </message>
    <message>
      <source>smallest thickness, mm</source>
      <translation>spessore minimo, mm</translation>
    </message>
    <message>
      <source>status</source>
      <translation>stato</translation>
    </message>
    <message>
      <source>step</source>
      <translation>passo</translation>
    </message>
    <message>
      <source>step of its numbers</source>
      <translation>passo dei suoi numeri</translation>
    </message>
    <message>
      <source>strength</source>
      <translation>resistenza</translation>
    </message>
    <message>
      <source>strength along x</source>
      <translation>resistenza lungo x</translation>
    </message>
    <message>
      <source>strength along y</source>
      <translation>resistenza lungo y</translation>
    </message>
    <message>
      <source>strength along z</source>
      <translation>resistenza lungo z</translation>
    </message>
    <message>
      <source>stress, % of its limit</source>
      <translation>tensione, % del limite</translation>
    </message>
    <message>
      <source>strut radius, mm</source>
      <translation>raggio delle aste, mm</translation>
    </message>
    <message>
      <source>struts</source>
      <translation>aste</translation>
    </message>
    <message>
      <source>struts removed, free end</source>
      <translation>aste rimosse, estremità libera</translation>
    </message>
    <message>
      <source>thickness there, % of what was asked</source>
      <translation>spessore nel pezzo, % di quello richiesto</translation>
    </message>
    <message>
      <source>thin struts removed</source>
      <translation>aste sottili rimosse</translation>
    </message>
    <message>
      <source>through-holes</source>
      <translation>fori passanti</translation>
    </message>
    <message>
      <source>tile</source>
      <translation>tassello</translation>
    </message>
    <message>
      <source>triangles</source>
      <translation>triangoli</translation>
    </message>
    <message>
      <source>triangles that cross</source>
      <translation>triangoli che si intersecano</translation>
    </message>
    <message>
      <source>trim</source>
      <translation>taglio</translation>
    </message>
    <message>
      <source>vertices</source>
      <translation>vertici</translation>
    </message>
    <message>
      <source>voids</source>
      <translation>vuoti</translation>
    </message>
    <message>
      <source>volume</source>
      <translation>volume</translation>
    </message>
    <message>
      <source>volume, mm3</source>
      <translation>volume, mm3</translation>
    </message>
    <message>
      <source>voxels</source>
      <translation>voxel</translation>
    </message>
    <message>
      <source>watertight</source>
      <translation>stagno</translation>
    </message>
    <message>
      <source>with the skin</source>
      <translation>con il guscio</translation>
    </message>
    <message>
      <source>with the struts removed</source>
      <translation>con le aste rimosse</translation>
    </message>
    <message>
      <source>work of the loads, N mm</source>
      <translation>lavoro dei carichi, N mm</translation>
    </message>
    <message>
      <source>wrong neighbours</source>
      <translation>vicini sbagliati</translation>
    </message>
    <message>
      <source>wrongly oriented triangles</source>
      <translation>triangoli orientati male</translation>
    </message>
    <message>
      <source>yes</source>
      <translation>sì</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSectionView</name>
    <message>
      <source>Across</source>
      <translation>Perpendicolare a</translation>
    </message>
    <message>
      <source>Other side</source>
      <translation>Altro lato</translation>
    </message>
    <message>
      <source>Section of {label}</source>
      <translation>Sezione di {label}</translation>
    </message>
    <message>
      <source>The axis that the plane lies across</source>
      <translation>L'asse a cui il piano è perpendicolare</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSentences</name>
    <message>
      <source>'{element}' has no direction: pick a straight or a round edge, a plane or a round face, an axis or a plane.</source>
      <translation>'{element}' non ha una direzione: scegliere uno spigolo dritto o circolare, una faccia piana o circolare, un asse o un piano.</translation>
    </message>
    <message>
      <source>'{element}' has no middle: pick a vertex, edge or face.</source>
      <translation>'{element}' non ha un centro: scegliere un vertice, uno spigolo o una faccia.</translation>
    </message>
    <message>
      <source>'{element}' is no face of the part: pick faces of it, or another solid.</source>
      <translation>'{element}' non è una faccia del pezzo: scegliere facce del pezzo o un altro solido.</translation>
    </message>
    <message>
      <source>'{label}' has no mesh to check: update it first.</source>
      <translation>'{label}' non ha una mesh da verificare: aggiornarlo prima.</translation>
    </message>
    <message>
      <source>'{label}' has no mesh to export: update it first.</source>
      <translation>'{label}' non ha una mesh da esportare: aggiornarlo prima.</translation>
    </message>
    <message>
      <source>'{label}' holds no lattice: set its Output to part.</source>
      <translation>'{label}' non contiene un reticolo: impostare il suo Risultato (Output) su Part.</translation>
    </message>
    <message>
      <source>'{label}' is a {shape} without a solid: choose a solid, or close it and convert it to one (Part &gt; Convert to solid).</source>
      <translation>'{label}' ha facce ({shape}) ma nessun solido: scegliere un solido, oppure chiuderle e convertirle (Part &gt; Converti in solido).</translation>
    </message>
    <message>
      <source>'{label}' is no solid: choose one.</source>
      <translation>'{label}' non è un solido: sceglierne uno.</translation>
    </message>
    <message>
      <source>'{label}' is not a lattice infill: choose one.</source>
      <translation>'{label}' non è un riempimento reticolare: sceglierne uno.</translation>
    </message>
    <message>
      <source>'{label}' is out of date: recompute it first.</source>
      <translation>'{label}' non è aggiornato: ricalcolarlo prima.</translation>
    </message>
    <message>
      <source>'{label}' is out of date: update it first.</source>
      <translation>'{label}' non è aggiornato: aggiornarlo prima.</translation>
    </message>
    <message>
      <source>'{label}' refers to no face, edge or vertex: choose some of the part's.</source>
      <translation>'{label}' non si riferisce a facce, spigoli o vertici: sceglierne del pezzo.</translation>
    </message>
    <message>
      <source>0: it carries nothing that way</source>
      <translation>0: in quella direzione non porta nulla</translation>
    </message>
    <message>
      <source>1 closed void holds {volume} mm3 of unused material: open each with a hole of {hole} mm or more.</source>
      <translation>1 vuoto chiuso contiene {volume} mm3 di materiale inutilizzato: aprirlo con un foro di {hole} mm o più.</translation>
    </message>
    <message>
      <source>A network along faces has none: pick one or two of the solid as NetworkFaces.</source>
      <translation>Una rete lungo facce non ne ha: scegliere una o due facce del solido come NetworkFaces.</translation>
    </message>
    <message>
      <source>A resolution of {given} is too coarse for struts of radius {radius} mm, which would not have their volume: {facets} facets along a cell are made.</source>
      <translation>Una risoluzione di {given} è troppo grossolana per aste di raggio {radius} mm, che non avrebbero il loro volume: si generano {facets} faccette lungo una cella.</translation>
    </message>
    <message>
      <source>A stiffness that drives the radius is that of a material: choose one for the infill.</source>
      <translation>Una rigidezza che determina il raggio è quella di un materiale: sceglierne uno per il riempimento.</translation>
    </message>
    <message>
      <source>All figures are of struts as printed ({table}), {thin} to {thick} mm thick; drawn are {least} to {most} mm, {mass} g.</source>
      <translation>Tutti i valori sono di aste come stampate ({table}), spesse da {thin} a {thick} mm; disegnate sono da {least} a {most} mm, {mass} g.</translation>
    </message>
    <message>
      <source>All figures are of struts as printed ({table}), {thin} to {thick} mm thick; drawn are {least} to {most} mm, {mass} g; stress and buckling are of struts thinner by {scatters} standard deviations.</source>
      <translation>Tutti i valori sono di aste come stampate ({table}), spesse da {thin} a {thick} mm; disegnate sono da {least} a {most} mm, {mass} g; tensione e instabilità sono di aste più sottili di {scatters} deviazioni standard.</translation>
    </message>
    <message>
      <source>An expression or another object says how '{label}' lies: turn that instead.</source>
      <translation>Un'espressione o un altro oggetto dice come è disposto '{label}': ruotare quello.</translation>
    </message>
    <message>
      <source>Built along none of the part's axes the cell carries without flatter struts: choose another one, such as {cells} with its z upwards.</source>
      <translation>Costruita lungo nessun asse del pezzo la cella porta senza aste più piatte: sceglierne un'altra, come {cells} con z verso l'alto.</translation>
    </message>
    <message>
      <source>Built along {axis} the lattice carries without flatter struts: choose that build direction where you can.</source>
      <translation>Costruito lungo {axis}, il reticolo porta senza aste più piatte: scegliere, se possibile, questa direzione di costruzione.</translation>
    </message>
    <message>
      <source>Built along {axis} the lattice without flatter struts is {times} times as stiff for its volume: choose that build direction where you can.</source>
      <translation>Costruito lungo {axis}, il reticolo senza aste più piatte è, a pari volume, {times} volte più rigido: scegliere, se possibile, questa direzione di costruzione.</translation>
    </message>
    <message>
      <source>Cancelled: other figures are those of the last finished check, if there was one.</source>
      <translation>Annullato: gli altri valori sono quelli dell'ultima verifica terminata, se ce n'è stata una.</translation>
    </message>
    <message>
      <source>Cancelled: the bands are those of the last recompute, if there was one.</source>
      <translation>Annullato: le fasce sono quelle dell'ultimo ricalcolo, se c'è stato.</translation>
    </message>
    <message>
      <source>Cancelled: the mesh is that of the last finished update; use Update Lattice Infill to try again.</source>
      <translation>Annullato: la mesh è quella dell'ultimo aggiornamento completato; usare Aggiorna riempimento reticolare per riprovare.</translation>
    </message>
    <message>
      <source>Cancelled: there is no mesh yet; use Update Lattice Infill to make it.</source>
      <translation>Annullato: non c'è ancora una mesh; usare Aggiorna riempimento reticolare per crearla.</translation>
    </message>
    <message>
      <source>Cancelled: what was done is kept, and the next start goes on from there.</source>
      <translation>Annullato: ciò che è stato fatto rimane, e il prossimo avvio prosegue da lì.</translation>
    </message>
    <message>
      <source>Cells of {size} mm are larger than the part, which measures {x} x {y} x {z} mm: reduce the cell size, or see whether the part is in another unit.</source>
      <translation>Le celle di {size} mm sono più grandi del pezzo, che misura {x} x {y} x {z} mm: ridurre la dimensione delle celle, o controllare se il pezzo è in un'altra unità.</translation>
    </message>
    <message>
      <source>Cells of {size} mm are too large for struts of radius {radius} mm: make the cells {largest} mm or smaller, or the struts {thinnest} mm or thicker.</source>
      <translation>Le celle di {size} mm sono troppo grandi per aste di raggio {radius} mm: fare le celle di {largest} mm o meno, o le aste di {thinnest} mm o più.</translation>
    </message>
    <message>
      <source>Choose limits, a printer whose struts are known, or both.</source>
      <translation>Scegliere dei limiti, una stampante di cui si conoscono le aste, o entrambi.</translation>
    </message>
    <message>
      <source>Every strut has a free end or is too thin, so that none is left: keep dangling and thin struts, reduce the cell size or choose the activation 'touching'.</source>
      <translation>Ogni asta ha un'estremità libera o è troppo sottile, e non ne resta nessuna: tenere le aste libere e sottili, ridurre la dimensione delle celle o tenere tutte le celle che toccano il pezzo.</translation>
    </message>
    <message>
      <source>Every strut lies too flat to be built, or has a free end without those, so that none is left: choose another build direction or cell</source>
      <translation>ogni asta è troppo piatta per essere costruita o ha senza quelle un'estremità libera, così che non ne resta nessuna: scegliere un'altra direzione di costruzione o cella</translation>
    </message>
    <message>
      <source>Failed: see the report view</source>
      <translation>Non riuscito: vedere il report</translation>
    </message>
    <message>
      <source>Flat struts hang free over up to {length} mm near {place}, and {process} bridges {most} mm: make the cells smaller or choose another build direction.</source>
      <translation>Aste piane restano sospese fino a {length} mm vicino a {place}, e {process} fa ponti di {most} mm: rimpicciolire le celle o scegliere un'altra direzione di costruzione.</translation>
    </message>
    <message>
      <source>Least mass needs a limit: of stress, displacement, buckling, frequency.</source>
      <translation>La massa minima richiede un limite: di tensione, spostamento, instabilità, frequenza.</translation>
    </message>
    <message>
      <source>Neither the infill nor its load cases have a material: choose one for the infill.</source>
      <translation>Né il riempimento né i suoi casi di carico hanno un materiale: sceglierne uno per il riempimento.</translation>
    </message>
    <message>
      <source>No TPMS lies inside the skin: reduce the skin thickness.</source>
      <translation>Nessuna TPMS sta dentro il guscio: ridurre lo spessore del guscio.</translation>
    </message>
    <message>
      <source>No cell of {size} mm has its centre inside the domain: reduce the cell size or choose the activation 'touching'.</source>
      <translation>Nessuna cella di {size} mm ha il centro all'interno: ridurre la dimensione delle celle o tenere tutte le celle che toccano il pezzo.</translation>
    </message>
    <message>
      <source>No cell of {size} mm lies wholly inside the domain: reduce the cell size or choose the activation 'touching'.</source>
      <translation>Nessuna cella di {size} mm sta tutta all'interno: ridurre la dimensione delle celle o tenere tutte le celle che toccano il pezzo.</translation>
    </message>
    <message>
      <source>No coupon is chosen: tick at least one.</source>
      <translation>Non è scelto alcun provino: spuntarne almeno uno.</translation>
    </message>
    <message>
      <source>No heat has a temperature: give one to where the heat leaves.</source>
      <translation>Nessuna temperatura è data: darne una dove il calore esce.</translation>
    </message>
    <message>
      <source>No load case has heat: give faces a temperature or a heat flow.</source>
      <translation>Nessun caso di carico ha calore: dare a delle facce una temperatura o un flusso di calore.</translation>
    </message>
    <message>
      <source>No load case is chosen: tick at least one.</source>
      <translation>Nessun caso di carico è scelto: spuntarne almeno uno.</translation>
    </message>
    <message>
      <source>No process is chosen to build for: choose one for the infill.</source>
      <translation>Non è scelto alcun processo per cui costruire: sceglierne uno per il riempimento.</translation>
    </message>
    <message>
      <source>No strut of cells of {size} mm lies inside the skin: reduce the cell size or the skin thickness.</source>
      <translation>Nessuna asta di celle di {size} mm sta dentro il guscio: ridurre la dimensione delle celle o lo spessore del guscio.</translation>
    </message>
    <message>
      <source>No strut of the network lies inside the skin: reduce the skin thickness.</source>
      <translation>Nessuna asta della rete sta dentro il guscio: ridurre lo spessore del guscio.</translation>
    </message>
    <message>
      <source>No strut radius gives a mass of {value} with {cells}: choose one from {least} to {most}, of which the skin is {skin}.</source>
      <translation>Nessun raggio delle aste dà una massa di {value} con {cells}: sceglierne una da {least} a {most}, di cui il guscio è {skin}.</translation>
    </message>
    <message>
      <source>No strut radius gives a mass of {value} with {cells}: choose one from {least} to {most}.</source>
      <translation>Nessun raggio delle aste dà una massa di {value} con {cells}: sceglierne una da {least} a {most}.</translation>
    </message>
    <message>
      <source>No strut radius gives a relative density of {value} with {cells}: choose one from {least} to {most}.</source>
      <translation>Nessun raggio delle aste dà una densità relativa di {value} con {cells}: sceglierne una da {least} a {most}.</translation>
    </message>
    <message>
      <source>Not enough memory: choose larger cells or a coarser deviation.</source>
      <translation>Memoria insufficiente: scegliere celle più grandi o uno scostamento più grossolano.</translation>
    </message>
    <message>
      <source>Not run yet</source>
      <translation>Non ancora eseguito</translation>
    </message>
    <message>
      <source>Open faces, drain holes, faces with a skin of their own, and what is kept solid, need a skin that they belong to: give a skin thickness above 0.</source>
      <translation>Facce aperte, fori di scarico, facce con un guscio proprio e ciò che resta pieno richiedono un guscio a cui appartenere: dare uno spessore del guscio maggiore di 0.</translation>
    </message>
    <message>
      <source>Out of date: AutoUpdate is off, use Update Lattice Infill</source>
      <translation>Non aggiornato: AutoUpdate è disattivato, usare Aggiorna riempimento reticolare</translation>
    </message>
    <message>
      <source>Out of date: a large job, use Update Lattice Infill</source>
      <translation>Non aggiornato: un calcolo grande, usare Aggiorna riempimento reticolare</translation>
    </message>
    <message>
      <source>Out of date: the mesh of these values is not there yet</source>
      <translation>Non aggiornato: la mesh di questi valori non c'è ancora</translation>
    </message>
    <message>
      <source>Out of date: values have changed since this mesh was asked for; recompute</source>
      <translation>Non aggiornato: i valori sono cambiati da quando questa mesh è stata chiesta; ricalcolare</translation>
    </message>
    <message>
      <source>Out of date: values have changed since this mesh was made; recompute</source>
      <translation>Non aggiornato: i valori sono cambiati da quando questa mesh è stata creata; ricalcolare</translation>
    </message>
    <message>
      <source>Results of {case}</source>
      <translation>Risultati: {case}</translation>
    </message>
    <message>
      <source>Results were of a wrong type, as another program leaves them: recompute for new ones</source>
      <translation>I risultati erano di tipo errato, come li lascia un altro programma: ricalcolare per averne di nuovi</translation>
    </message>
    <message>
      <source>Saved by a FreeCAD without VOLFREP: recompute, and whatever was changed there is followed</source>
      <translation>Salvato da un FreeCAD senza VOLFREP: ricalcolare, e ciò che vi è stato cambiato viene seguito</translation>
    </message>
    <message>
      <source>Struts are down to {thin} mm thick near {place}, and {process} wants {least} mm: enlarge the radius.</source>
      <translation>Ci sono aste di soli {thin} mm di spessore vicino a {place}, e {process} richiede {least} mm: aumentare il raggio.</translation>
    </message>
    <message>
      <source>Struts are no thinner than {process} prints: {radius} mm in radius.</source>
      <translation>Le aste non sono più sottili di quanto {process} stampa: {radius} mm di raggio.</translation>
    </message>
    <message>
      <source>Struts are only {gap} mm apart near {place}, and {process} wants {least} mm: they may fuse or hold powder; enlarge the cells.</source>
      <translation>Le aste distano solo {gap} mm vicino a {place}, e {process} richiede {least} mm: possono fondersi o trattenere polvere; ingrandire le celle.</translation>
    </message>
    <message>
      <source>Struts of radius {radius} mm are too thick for a cell of {size} mm: keep the radius below {limit} mm or enlarge the cell.</source>
      <translation>Aste di raggio {radius} mm sono troppo spesse per una cella di {size} mm: tenere il raggio sotto {limit} mm o ingrandire la cella.</translation>
    </message>
    <message>
      <source>Struts of {diameter} mm are thinner than {process} prints: at least {least} mm.</source>
      <translation>Aste di {diameter} mm sono più sottili di quanto {process} stampi: almeno {least} mm.</translation>
    </message>
    <message>
      <source>Struts that lie flatter than {process} builds stay: {reason}.</source>
      <translation>Le aste più piatte di quanto {process} costruisce restano: {reason}.</translation>
    </message>
    <message>
      <source>The Python that goes with this FreeCAD cannot run the engine by itself: runs are done one after the other.</source>
      <translation>Il Python di questo FreeCAD non può eseguire il motore da solo: i calcoli si fanno uno dopo l'altro.</translation>
    </message>
    <message>
      <source>The cell type Custom needs a cell: choose its .json file as CellFile.</source>
      <translation>Il tipo di cella Custom richiede una cella: scegliere il suo file .json come CellFile.</translation>
    </message>
    <message>
      <source>The document has no load case: make one with Loads and Sizing, or an analysis with the FEM workbench, with constraints on the solid's faces, edges or vertices.</source>
      <translation>Il documento non ha casi di carico: crearne uno con Carichi e dimensionamento, oppure un'analisi con l'ambiente FEM, con vincoli su facce, spigoli o vertici del solido.</translation>
    </message>
    <message>
      <source>The engine failed with a {kind} ({error}), which is a defect of VOLFREP: please report it with the traceback in the report view's log messages.</source>
      <translation>Il motore si è fermato con un {kind} ({error}), che è un difetto di VOLFREP: segnalarlo con il traceback che è nei messaggi di log del rapporto.</translation>
    </message>
    <message>
      <source>The expression '{expression}' of {name} has no value ({reason}): correct it.</source>
      <translation>L'espressione '{expression}' di {name} non ha un valore ({reason}): correggerla.</translation>
    </message>
    <message>
      <source>The infill of this study has gone: choose another one as Infill.</source>
      <translation>Il riempimento di questo studio non c'è più: sceglierne un altro come Infill.</translation>
    </message>
    <message>
      <source>The lattice is {bodies} bodies that do not touch each other: only the part's skin holds them together.</source>
      <translation>Il reticolo è fatto di {bodies} corpi che non si toccano: li tiene insieme solo il guscio del pezzo.</translation>
    </message>
    <message>
      <source>The load cases have heat alone: hold faces and load some, too.</source>
      <translation>I casi di carico hanno solo calore: vincolare delle facce e caricarne altre.</translation>
    </message>
    <message>
      <source>The material Custom needs a file: choose its .toml or .json file as MaterialFile.</source>
      <translation>Il materiale Custom richiede un file: scegliere il suo file .toml o .json come MaterialFile.</translation>
    </message>
    <message>
      <source>The mesh of '{label}' is out of date ({why}): recompute it for a present one.</source>
      <translation>La mesh di '{label}' non è aggiornata ({why}): ricalcolarla per averne una attuale.</translation>
    </message>
    <message>
      <source>The part is nowhere thicker than two skins of {shell} mm, so that nothing is left to fill: reduce the skin thickness.</source>
      <translation>Il pezzo non è da nessuna parte più spesso di due gusci di {shell} mm, e non resta nulla da riempire: ridurre lo spessore del guscio.</translation>
    </message>
    <message>
      <source>The skin and what is kept solid leave nothing to fill: reduce the skin thickness, that of faces with their own, or what is kept solid.</source>
      <translation>Il guscio e ciò che resta pieno non lasciano nulla da riempire: ridurre lo spessore del guscio, quello delle facce con uno proprio, o ciò che resta pieno.</translation>
    </message>
    <message>
      <source>The skin is no thinner than {process} prints: {wall} mm.</source>
      <translation>Il guscio non è più sottile di quanto {process} stampa: {wall} mm.</translation>
    </message>
    <message>
      <source>The solid's conductivity is not known: type it in Loads and Sizing, W/(m K).</source>
      <translation>La conducibilità del materiale non è nota: scriverla in Carichi e dimensionamento, W/(m K).</translation>
    </message>
    <message>
      <source>The void about {place} has room for {room} of its {wanted} drain holes: choose a smaller diameter, or give their places.</source>
      <translation>Il vuoto intorno a {place} ha posto per {room} dei suoi {wanted} fori di scarico: scegliere un diametro minore, o indicarne i punti.</translation>
    </message>
    <message>
      <source>There is no lattice infill: make one of a solid first.</source>
      <translation>Non c'è alcun riempimento reticolare: crearne prima uno da un solido.</translation>
    </message>
    <message>
      <source>There is no solid to fill: choose one as Base.</source>
      <translation>Non c'è un solido da riempire: sceglierne uno come Base.</translation>
    </message>
    <message>
      <source>There is no solid to print: choose one as Base.</source>
      <translation>Non c'è un solido da stampare: sceglierne uno come Base.</translation>
    </message>
    <message>
      <source>There is nothing to look at: choose a lattice infill as Infill.</source>
      <translation>Non c'è nulla da verificare: scegliere un riempimento reticolare come Infill.</translation>
    </message>
    <message>
      <source>There is nothing to vary: choose a lattice infill as Infill.</source>
      <translation>Non c'è nulla da variare: scegliere un riempimento reticolare come Infill.</translation>
    </message>
    <message>
      <source>Two load cases have heat, '{one}' and '{other}': choose one, or suppress the heat of the other.</source>
      <translation>Due casi di carico hanno calore, '{one}' e '{other}': sceglierne uno, o sopprimere il calore dell'altro.</translation>
    </message>
    <message>
      <source>Up to date</source>
      <translation>Aggiornato</translation>
    </message>
    <message>
      <source>Walls are down to {wall} mm thick in every cell, and {process} wants {least} mm: make them thicker, or enlarge the cells of a skeleton.</source>
      <translation>Ci sono pareti di soli {wall} mm in ogni cella, e {process} richiede {least} mm: farle più spesse, o ingrandire le celle di uno scheletro.</translation>
    </message>
    <message>
      <source>Walls are only {gap} mm apart in every cell, and {process} wants {least} mm: they may fuse or hold powder; make them thinner, or enlarge the cells.</source>
      <translation>Le pareti distano solo {gap} mm in ogni cella, e {process} richiede {least} mm: possono fondersi o trattenere polvere; farle più sottili, o ingrandire le celle.</translation>
    </message>
    <message>
      <source>Walls of {thickness} mm are too thick for a cell of {size} mm: reduce the thickness or enlarge the cell.</source>
      <translation>Pareti di {thickness} mm sono troppo spesse per una cella di {size} mm: ridurre lo spessore o ingrandire la cella.</translation>
    </message>
    <message>
      <source>as even: {density} % everywhere would take the same</source>
      <translation>uniforme: {density} % ovunque ne richiederebbe altrettanto</translation>
    </message>
    <message>
      <source>band {number}: {mean} % of {volume} mm3, told as {told} %</source>
      <translation>banda {number}: {mean} % di {volume} mm3, comunicata come {told} %</translation>
    </message>
    <message>
      <source>band {number}: {mean} % of {volume} mm3, told as {told} % (narrow: joined ends of lines make up the rest)</source>
      <translation>banda {number}: {mean} % di {volume} mm3, comunicata come {told} % (stretta: le estremità unite delle linee fanno il resto)</translation>
    </message>
    <message>
      <source>below {angle} degrees</source>
      <translation>sotto {angle} gradi</translation>
    </message>
    <message>
      <source>cells '{cell}' of {size} mm</source>
      <translation>celle '{cell}' di {size} mm</translation>
    </message>
    <message>
      <source>closed voids</source>
      <translation>vuoti chiusi</translation>
    </message>
    <message>
      <source>filament: {volume} mm3, {mass} g</source>
      <translation>filamento: {volume} mm3, {mass} g</translation>
    </message>
    <message>
      <source>findings</source>
      <translation>rilievi</translation>
    </message>
    <message>
      <source>inclinations</source>
      <translation>inclinazioni</translation>
    </message>
    <message>
      <source>its present values cannot be computed</source>
      <translation>i suoi valori attuali non si possono calcolare</translation>
    </message>
    <message>
      <source>largest ball that gets out</source>
      <translation>sfera più grande che esce</translation>
    </message>
    <message>
      <source>limits from</source>
      <translation>limiti da</translation>
    </message>
    <message>
      <source>longest flat</source>
      <translation>piana più lunga</translation>
    </message>
    <message>
      <source>longest of these</source>
      <translation>la più lunga di queste</translation>
    </message>
    <message>
      <source>mass</source>
      <translation>massa</translation>
    </message>
    <message>
      <source>narrowest gap</source>
      <translation>luce più stretta</translation>
    </message>
    <message>
      <source>none</source>
      <translation>nessuno</translation>
    </message>
    <message>
      <source>over {value} (limit {limit})</source>
      <translation>oltre {value} (limite {limit})</translation>
    </message>
    <message>
      <source>process</source>
      <translation>processo</translation>
    </message>
    <message>
      <source>solid: {volume} mm3 of walls and solid layers</source>
      <translation>pieno: {volume} mm3 di pareti e strati pieni</translation>
    </message>
    <message>
      <source>surface</source>
      <translation>superficie</translation>
    </message>
    <message>
      <source>thinnest strut</source>
      <translation>asta più sottile</translation>
    </message>
    <message>
      <source>thinnest wall</source>
      <translation>parete più sottile</translation>
    </message>
    <message>
      <source>values or the solid have changed since it was made</source>
      <translation>i valori o il solido sono cambiati da quando è stata fatta</translation>
    </message>
    <message>
      <source>what it is made of has changed and is not recomputed yet</source>
      <translation>ciò di cui è fatta è cambiato e non è ancora ricalcolato</translation>
    </message>
    <message>
      <source>without them the limits cannot be held</source>
      <translation>senza di esse i limiti non si possono rispettare</translation>
    </message>
    <message>
      <source>{active} of {total} cells, {triangles} triangles, {mass} g in {seconds} s</source>
      <translation>{active} celle su {total}, {triangles} triangoli, {mass} g in {seconds} s</translation>
    </message>
    <message>
      <source>{classes} % from 0 to 90 degrees, by {step}</source>
      <translation>{classes} % da 0 a 90 gradi, ogni {step}</translation>
    </message>
    <message>
      <source>{count} cells are too many to be shown as lines: enlarge the cells.</source>
      <translation>{count} celle sono troppe per essere mostrate come linee: ingrandire le celle.</translation>
    </message>
    <message>
      <source>{count} closed voids hold {volume} mm3 of unused material: open each with a hole of {hole} mm or more.</source>
      <translation>{count} vuoti chiusi contengono {volume} mm3 di materiale inutilizzato: aprire ciascuno con un foro di {hole} mm o più.</translation>
    </message>
    <message>
      <source>{count}, holding {volume} mm3</source>
      <translation>{count}, con {volume} mm3</translation>
    </message>
    <message>
      <source>{designs} designs of {infill}</source>
      <translation>{designs} progetti di {infill}</translation>
    </message>
    <message>
      <source>{figure} E of the solid</source>
      <translation>{figure} di E del materiale pieno</translation>
    </message>
    <message>
      <source>{figure} of the solid's</source>
      <translation>{figure} di quella del materiale pieno</translation>
    </message>
    <message>
      <source>{figure} of the solid's yield stress</source>
      <translation>{figure} dello snervamento del materiale pieno</translation>
    </message>
    <message>
      <source>{material} is printed by {processes}, not by {process}.</source>
      <translation>{material} si stampa con {processes}, non con {process}.</translation>
    </message>
    <message>
      <source>{name} has no values: write them as 6, 8, 10 or as 6 to 10 in 5.</source>
      <translation>{name} non ha valori: scriverli come 6, 8, 10 o come 6 to 10 in 5.</translation>
    </message>
    <message>
      <source>{process} builds {degrees} degrees and more without support, and {area} mm2 of ceilings within its skin, which only struts hold, are flatter, as at {place}: another build direction may have less.</source>
      <translation>{process} costruisce senza supporti da {degrees} gradi, e {area} mm2 di soffitti entro il guscio, tenuti solo da aste, sono più piatti, come a {place}: un'altra direzione di costruzione può averne meno.</translation>
    </message>
    <message>
      <source>{process} builds {degrees} degrees and more without support, and {area} mm2 of the part's outside are flatter, as at {place}: another build direction may have less.</source>
      <translation>{process} costruisce senza supporti da {degrees} gradi, e {area} mm2 dell'esterno del pezzo sono più piatti, come a {place}: un'altra direzione di costruzione può averne meno.</translation>
    </message>
    <message>
      <source>{removed} pieces that hang on nothing left out, {share} % of the lattice's volume: smaller cells or another origin may join them, and so does a skin.</source>
      <translation>Esclusi {removed} frammenti che non sono attaccati a nulla, {share} % del volume del reticolo: celle più piccole o un'altra origine possono unirli, e così un guscio.</translation>
    </message>
    <message>
      <source>{share} % of the struts' length is less than {inclination} degrees above the build plate: choose another build direction or cell, or count on sagging undersides.</source>
      <translation>Il {share} % della lunghezza delle aste è a meno di {inclination} gradi dal piano di stampa: scegliere un'altra direzione di costruzione o cella, o mettere in conto superfici inferiori cedevoli.</translation>
    </message>
    <message>
      <source>{share} % of the struts' length, {area}</source>
      <translation>{share} % della lunghezza delle aste, {area}</translation>
    </message>
    <message>
      <source>{solid} has no material in FreeCAD: give it one, or choose another for the infill.</source>
      <translation>{solid} non ha un materiale in FreeCAD: dargliene uno, o sceglierne un altro per il riempimento.</translation>
    </message>
    <message>
      <source>{value} (limit {limit})</source>
      <translation>{value} (limite {limit})</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSizePanel</name>
    <message>
      <source>A .csv file with the columns inclination, nominal, measured, as Coupons makes</source>
      <translation>Un file .csv con le colonne inclination, nominal, measured, come lo crea il comando Provini</translation>
    </message>
    <message>
      <source>All limits are held.</source>
      <translation>Tutti i limiti sono rispettati.</translation>
    </message>
    <message>
      <source>All limits are held; one radius and one thickness for all would weigh {even:.4g} g.</source>
      <translation>Tutti i limiti sono rispettati; con un solo raggio e un solo spessore sarebbero {even:.4g} g.</translation>
    </message>
    <message>
      <source>Analyses of the FEM workbench: each is a load case</source>
      <translation>Analisi dell'ambiente FEM: ognuna è un caso di carico</translation>
    </message>
    <message>
      <source>As drawn, or as this printer makes them: stress, stiffness and mass are then of struts as printed, and the radii found are those to draw</source>
      <translation>Come disegnato, o come le produce questa stampante: tensione, rigidezza e massa sono allora di aste come stampate, e i raggi trovati sono quelli da disegnare</translation>
    </message>
    <message>
      <source>Buckling safety</source>
      <translation>Sicurezza (instabilità)</translation>
    </message>
    <message>
      <source>CalculiX does not confirm this design: see its notes.</source>
      <translation>CalculiX non conferma questo progetto: vedi le sue note.</translation>
    </message>
    <message>
      <source>CalculiX's displacements of the same beams and skin differ by {off:.2g} %.</source>
      <translation>Gli spostamenti di CalculiX per le stesse travi e la stessa parete differiscono del {off:.2g} %.</translation>
    </message>
    <message>
      <source>CalculiX's displacements of the same beams differ by {off:.2g} %.</source>
      <translation>Gli spostamenti di CalculiX per le stesse travi differiscono del {off:.2g} %.</translation>
    </message>
    <message>
      <source>Cancelled before the first step.</source>
      <translation>Annullato prima del primo passo.</translation>
    </message>
    <message>
      <source>Check with CalculiX</source>
      <translation>Verifica con CalculiX</translation>
    </message>
    <message>
      <source>Conductivity</source>
      <translation>Conducibilità</translation>
    </message>
    <message>
      <source>Displacement</source>
      <translation>Spostamento</translation>
    </message>
    <message>
      <source>Find radii</source>
      <translation>Trova i raggi</translation>
    </message>
    <message>
      <source>Find temperatures</source>
      <translation>Trova le temperature</translation>
    </message>
    <message>
      <source>Find the radii now and stay in this panel; Cancel in the status bar keeps the best design so far</source>
      <translation>Trova ora i raggi e resta in questo pannello; Annulla nella barra di stato tiene il progetto migliore finora</translation>
    </message>
    <message>
      <source>Find the temperatures of the lattice as it is, and colour it</source>
      <translation>Trova le temperature del reticolo com'è e lo colora</translation>
    </message>
    <message>
      <source>For printing</source>
      <translation>Per la stampa</translation>
    </message>
    <message>
      <source>For {process}, built along {direction}: {count} struts that lie flatter than {degrees} degrees were taken away.</source>
      <translation>Per {process}, costruito lungo {direction}: {count} aste più piatte di {degrees} gradi sono state tolte.</translation>
    </message>
    <message>
      <source>Frequency, Hz</source>
      <translation>Frequenza, Hz</translation>
    </message>
    <message>
      <source>Goal</source>
      <translation>Obiettivo</translation>
    </message>
    <message>
      <source>Goal and limits</source>
      <translation>Obiettivo e limiti</translation>
    </message>
    <message>
      <source>Heat enters and leaves through these faces alone: none is lost to air.</source>
      <translation>Il calore entra ed esce solo da queste facce: nulla va perso nell'aria.</translation>
    </message>
    <message>
      <source>How many times the load may be before struts buckle, one alone or together; 0 for no limit</source>
      <translation>Quante volte il carico può essere prima che le aste si instabilizzino, una da sola o insieme; 0 per nessun limite</translation>
    </message>
    <message>
      <source>How mass and limits went, step by step</source>
      <translation>Come sono andati massa e limiti, passo per passo</translation>
    </message>
    <message>
      <source>Largest radius</source>
      <translation>Raggio massimo</translation>
    </message>
    <message>
      <source>Least mass</source>
      <translation>Massa minima</translation>
    </message>
    <message>
      <source>Let CalculiX solve the design, where it is installed, and say how far it agrees; where it finds more than a limit allows, the struts are made thicker</source>
      <translation>Fai risolvere il progetto a CalculiX, dove è installato, e di' quanto concorda; dove trova più di quanto un limite consenta, le aste diventano più spesse</translation>
    </message>
    <message>
      <source>Load cases</source>
      <translation>Casi di carico</translation>
    </message>
    <message>
      <source>Loads and Sizing: {label}</source>
      <translation>Carichi e dimensionamento: {label}</translation>
    </message>
    <message>
      <source>Mass, g</source>
      <translation>Massa, g</translation>
    </message>
    <message>
      <source>Most stiffness</source>
      <translation>Rigidezza massima</translation>
    </message>
    <message>
      <source>Most used limit</source>
      <translation>Limite più usato</translation>
    </message>
    <message>
      <source>Nodes whose struts would grow together stay below it</source>
      <translation>I nodi le cui aste si fonderebbero restano al di sotto</translation>
    </message>
    <message>
      <source>Of the skin {solid:.4g} g are solid from side to side.</source>
      <translation>Del guscio {solid:.4g} g sono pieni da un lato all'altro.</translation>
    </message>
    <message>
      <source>Of the solid material, as its data sheet says</source>
      <translation>Del materiale pieno, come dice la sua scheda tecnica</translation>
    </message>
    <message>
      <source>Plot</source>
      <translation>Grafico</translation>
    </message>
    <message>
      <source>Remove struts that carry little</source>
      <translation>Togli aste che portano poco</translation>
    </message>
    <message>
      <source>Size the skin, too, from this thickness on; 0 leaves it as it is</source>
      <translation>Dimensionare anche il guscio, da questo spessore in su; 0 lo lascia com'è</translation>
    </message>
    <message>
      <source>Smallest radius</source>
      <translation>Raggio minimo</translation>
    </message>
    <message>
      <source>Standard deviations</source>
      <translation>Deviazioni standard</translation>
    </message>
    <message>
      <source>Steady heat</source>
      <translation>Calore stazionario</translation>
    </message>
    <message>
      <source>Step</source>
      <translation>Passo</translation>
    </message>
    <message>
      <source>Steps of {label}</source>
      <translation>Passi di {label}</translation>
    </message>
    <message>
      <source>Stress and buckling are of struts thinner by so many standard deviations of the table</source>
      <translation>Tensione e instabilità sono di aste più sottili di tante deviazioni standard della tabella</translation>
    </message>
    <message>
      <source>Struts</source>
      <translation>Aste</translation>
    </message>
    <message>
      <source>Struts and skin no thinner than the process prints, and none flatter as far as limits allow</source>
      <translation>Aste e guscio non più sottili di quanto il processo stampa, e nessuna asta più piatta, per quanto i limiti permettono</translation>
    </message>
    <message>
      <source>Struts of {mass:.4g} g hold all limits; no one radius between these does.</source>
      <translation>Aste di {mass:.4g} g rispettano tutti i limiti; nessun raggio unico tra questi lo fa.</translation>
    </message>
    <message>
      <source>Struts of {mass:.4g} g hold all limits; of one radius they would weigh {even:.4g} g.</source>
      <translation>Aste di {mass:.4g} g rispettano tutti i limiti; con un raggio unico peserebbero {even:.4g} g.</translation>
    </message>
    <message>
      <source>Struts of {mass:.4g} g, {least:.3g} to {gain:.3g} times as stiff as struts of one radius and the same mass.</source>
      <translation>Aste di {mass:.4g} g, da {least:.3g} a {gain:.3g} volte più rigide di aste di raggio unico e della stessa massa.</translation>
    </message>
    <message>
      <source>Struts of {struts:.4g} g and a skin of {low:.3g} to {high:.3g} mm, {skin:.4g} g.</source>
      <translation>Aste di {struts:.4g} g e un guscio da {low:.3g} a {high:.3g} mm, {skin:.4g} g.</translation>
    </message>
    <message>
      <source>Take away struts that end as thin as the smallest radius and size the rest again; kept if that is lighter, or stiffer at the same mass</source>
      <translation>Toglie le aste che finiscono sottili come il raggio minimo e dimensiona di nuovo le altre; si tiene se è più leggero, o più rigido a parità di massa</translation>
    </message>
    <message>
      <source>Temperatures are {low} to {high} °C, {flow} W flow through.</source>
      <translation>Le temperature vanno da {low} a {high} °C, passano {flow} W.</translation>
    </message>
    <message>
      <source>The largest of any point under any case; 0 for no limit</source>
      <translation>Il massimo di ogni punto in ogni caso; 0 per nessun limite</translation>
    </message>
    <message>
      <source>The limit of {limit} cannot be held between these radii: {use:.0%} of it is used. Allow thicker struts, or larger cells.</source>
      <translation>Il limite di {limit} non può essere rispettato con questi raggi: ne è usato il {use:.0%}. Consenti aste più spesse, o celle più grandi.</translation>
    </message>
    <message>
      <source>The lowest natural one, held as in the first case; 0 for no limit</source>
      <translation>La più bassa propria, vincolata come nel primo caso; 0 per nessun limite</translation>
    </message>
    <message>
      <source>The thinnest strut that the process prints</source>
      <translation>L'asta più sottile che il processo stampa</translation>
    </message>
    <message>
      <source>Thermal resistance: {resistance} K/W.</source>
      <translation>Resistenza termica: {resistance} K/W.</translation>
    </message>
    <message>
      <source>Thickest skin</source>
      <translation>Guscio massimo</translation>
    </message>
    <message>
      <source>Thinnest skin</source>
      <translation>Guscio minimo</translation>
    </message>
    <message>
      <source>What the stiffest struts weigh, with a skin that is sized; 0 for what those of StrutRadius and the present skin do</source>
      <translation>Quanto pesano le aste più rigide, con un guscio che viene dimensionato; 0 per quanto pesano quelle di StrutRadius e il guscio attuale</translation>
    </message>
    <message>
      <source>Where more is needed the part becomes solid; 0 for half the cell size</source>
      <translation>Dove serve di più il pezzo diventa pieno; 0 per metà della cella</translation>
    </message>
    <message>
      <source>Work, N mm</source>
      <translation>Lavoro, N mm</translation>
    </message>
    <message>
      <source>Yield safety</source>
      <translation>Sicurezza (snervamento)</translation>
    </message>
    <message>
      <source>Yield stress over the largest von Mises stress in a strut; 0 for no limit</source>
      <translation>Tensione di snervamento sulla massima tensione di von Mises in un'asta; 0 per nessun limite</translation>
    </message>
    <message>
      <source>buckling</source>
      <translation>instabilità</translation>
    </message>
    <message>
      <source>displacement</source>
      <translation>spostamento</translation>
    </message>
    <message>
      <source>frame buckling</source>
      <translation>instabilità d'insieme</translation>
    </message>
    <message>
      <source>frequency</source>
      <translation>frequenza</translation>
    </message>
    <message>
      <source>largest radius</source>
      <translation>raggio massimo</translation>
    </message>
    <message>
      <source>largest thickness</source>
      <translation>spessore massimo</translation>
    </message>
    <message>
      <source>one radius for all</source>
      <translation>un raggio per tutti</translation>
    </message>
    <message>
      <source>skin stress</source>
      <translation>tensione del guscio</translation>
    </message>
    <message>
      <source>smallest radius</source>
      <translation>raggio minimo</translation>
    </message>
    <message>
      <source>smallest thickness</source>
      <translation>spessore minimo</translation>
    </message>
    <message>
      <source>stiffness</source>
      <translation>rigidezza</translation>
    </message>
    <message>
      <source>stress</source>
      <translation>tensione</translation>
    </message>
    <message>
      <source>thickened with others</source>
      <translation>ingrossato con gli altri</translation>
    </message>
    <message>
      <source>{process}, built along {direction}: struts from {strut} mm thick and {degrees} degrees steep, walls from {wall} mm</source>
      <translation>{process}, costruito lungo {direction}: aste da {strut} mm di spessore e {degrees} gradi di pendenza, pareti da {wall} mm</translation>
    </message>
    <message>
      <source>{process}, built along {direction}: struts from {strut} mm thick, walls from {wall} mm</source>
      <translation>{process}, costruito lungo {direction}: aste da {strut} mm di spessore, pareti da {wall} mm</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSlicer</name>
    <message>
      <source>Along</source>
      <translation>Lungo</translation>
    </message>
    <message>
      <source>Bands</source>
      <translation>Bande</translation>
    </message>
    <message>
      <source>Bottom layers</source>
      <translation>Strati inferiori</translation>
    </message>
    <message>
      <source>Density follows</source>
      <translation>La densità segue</translation>
    </message>
    <message>
      <source>Depth, dense core</source>
      <translation>Profondità, nucleo denso</translation>
    </message>
    <message>
      <source>Depth, dense skin</source>
      <translation>Profondità, guscio denso</translation>
    </message>
    <message>
      <source>Direction</source>
      <translation>Direzione</translation>
    </message>
    <message>
      <source>Down to depth</source>
      <translation>Fino a profondità</translation>
    </message>
    <message>
      <source>FEM result</source>
      <translation>Risultato FEM</translation>
    </message>
    <message>
      <source>Field file</source>
      <translation>File di campo</translation>
    </message>
    <message>
      <source>Fields (*.csv *.txt *.vtu *.vtk)</source>
      <translation>Campi (*.csv *.txt *.vtu *.vtk)</translation>
    </message>
    <message>
      <source>Filament</source>
      <translation>Filamento</translation>
    </message>
    <message>
      <source>Filament: {volume} cm³, {mass} g, of which {solid} cm³ are walls and solid layers. Everywhere {even} % would take the same.</source>
      <translation>Filamento: {volume} cm³, {mass} g, di cui {solid} cm³ di pareti e strati pieni. Ovunque {even} % richiederebbe lo stesso.</translation>
    </message>
    <message>
      <source>File</source>
      <translation>File</translation>
    </message>
    <message>
      <source>Follows</source>
      <translation>Segue</translation>
    </message>
    <message>
      <source>Formula</source>
      <translation>Formula</translation>
    </message>
    <message>
      <source>From</source>
      <translation>Da</translation>
    </message>
    <message>
      <source>Layer height</source>
      <translation>Altezza strato</translation>
    </message>
    <message>
      <source>Line width</source>
      <translation>Larghezza linea</translation>
    </message>
    <message>
      <source>Object</source>
      <translation>Oggetto</translation>
    </message>
    <message>
      <source>Of each band: the density that is wanted, what the slicer is told so that it lays as much, and the volume of its sparse infill</source>
      <translation>Di ogni banda: la densità voluta, ciò che si comunica allo slicer perché deponga altrettanto, e il volume del suo riempimento rado</translation>
    </message>
    <message>
      <source>Pattern</source>
      <translation>Motivo</translation>
    </message>
    <message>
      <source>Percent of x, y, z</source>
      <translation>Percento da x, y, z</translation>
    </message>
    <message>
      <source>Print</source>
      <translation>Stampa</translation>
    </message>
    <message>
      <source>Quantity</source>
      <translation>Grandezza</translation>
    </message>
    <message>
      <source>Show Bands</source>
      <translation>Mostra bande</translation>
    </message>
    <message>
      <source>Sized lattice</source>
      <translation>Reticolo dimensionato</translation>
    </message>
    <message>
      <source>Slicer</source>
      <translation>Slicer</translation>
    </message>
    <message>
      <source>To</source>
      <translation>A</translation>
    </message>
    <message>
      <source>Top layers</source>
      <translation>Strati superiori</translation>
    </message>
    <message>
      <source>Walls</source>
      <translation>Pareti</translation>
    </message>
    <message>
      <source>band</source>
      <translation>banda</translation>
    </message>
    <message>
      <source>density</source>
      <translation>densità</translation>
    </message>
    <message>
      <source>value:percent</source>
      <translation>valore:percento</translation>
    </message>
  </context>
  <context>
    <name>VolfrepSolids</name>
    <message>
      <source>Axes of the struts</source>
      <translation>Assi delle aste</translation>
    </message>
    <message>
      <source>Links to one solid for each kind of joint</source>
      <translation>Link a un solido per ogni tipo di nodo</translation>
    </message>
    <message>
      <source>One solid of exact surfaces</source>
      <translation>Un solido di superfici esatte</translation>
    </message>
    <message>
      <source>One solid of plane faces</source>
      <translation>Un solido di facce piane</translation>
    </message>
  </context>
  <context>
    <name>VolfrepStudy</name>
    <message>
      <source>Apply</source>
      <translation>Applica</translation>
    </message>
    <message>
      <source>Give this design to the infill, as one undo step</source>
      <translation>Dà questo progetto al riempimento, come un solo passo annullabile</translation>
    </message>
    <message>
      <source>Mesh and measure every design</source>
      <translation>Generare e misurare ogni progetto</translation>
    </message>
    <message>
      <source>Not run yet: choose what varies, then press Start.</source>
      <translation>Non ancora eseguito: scegliere che cosa varia, poi premere Avvia.</translation>
    </message>
    <message>
      <source>Open report</source>
      <translation>Aprire il rapporto</translation>
    </message>
    <message>
      <source>Poisson's ratio</source>
      <translation>coefficiente di Poisson</translation>
    </message>
    <message>
      <source>Show the table and all plots in the browser</source>
      <translation>Mostra la tabella e tutti i grafici nel browser</translation>
    </message>
    <message>
      <source>Start</source>
      <translation>Avvia</translation>
    </message>
    <message>
      <source>The infill of this study has gone: choose another one.</source>
      <translation>Il riempimento di questo studio non c'è più: sceglierne un altro.</translation>
    </message>
    <message>
      <source>Values: 6, 8, 10, or 6 to 10 in 5</source>
      <translation>Valori: 6, 8, 10, oppure 6 to 10 in 5</translation>
    </message>
    <message>
      <source>What varies</source>
      <translation>Che cosa varia</translation>
    </message>
    <message>
      <source>Zener anisotropy</source>
      <translation>anisotropia di Zener</translation>
    </message>
    <message>
      <source>bulk modulus</source>
      <translation>modulo di comprimibilità</translation>
    </message>
    <message>
      <source>conductivity, of the solid's</source>
      <translation>conducibilità, di quella del pieno</translation>
    </message>
    <message>
      <source>expected mass, g</source>
      <translation>massa prevista, g</translation>
    </message>
    <message>
      <source>expected relative density</source>
      <translation>densità relativa prevista</translation>
    </message>
    <message>
      <source>expected strut radius, mm</source>
      <translation>raggio atteso delle aste, mm</translation>
    </message>
    <message>
      <source>expected struts</source>
      <translation>aste attese</translation>
    </message>
    <message>
      <source>expected triangles</source>
      <translation>triangoli previsti</translation>
    </message>
    <message>
      <source>expected volume, mm3</source>
      <translation>volume atteso, mm3</translation>
    </message>
    <message>
      <source>mass, g</source>
      <translation>massa, g</translation>
    </message>
    <message>
      <source>memory, GB</source>
      <translation>memoria, GB</translation>
    </message>
    <message>
      <source>of the solid's</source>
      <translation>di quella del pieno</translation>
    </message>
    <message>
      <source>relative density</source>
      <translation>densità relativa</translation>
    </message>
    <message>
      <source>shear modulus</source>
      <translation>modulo di taglio</translation>
    </message>
    <message>
      <source>shear strength</source>
      <translation>resistenza a taglio</translation>
    </message>
    <message>
      <source>stiffness across a face</source>
      <translation>rigidezza attraverso una faccia</translation>
    </message>
    <message>
      <source>stiffness along a diagonal</source>
      <translation>rigidezza lungo una diagonale</translation>
    </message>
    <message>
      <source>stiffness along an edge</source>
      <translation>rigidezza lungo uno spigolo</translation>
    </message>
    <message>
      <source>strength</source>
      <translation>resistenza</translation>
    </message>
    <message>
      <source>strut radius, mm</source>
      <translation>raggio delle aste, mm</translation>
    </message>
    <message>
      <source>struts</source>
      <translation>aste</translation>
    </message>
    <message>
      <source>surface, mm2</source>
      <translation>superficie, mm2</translation>
    </message>
    <message>
      <source>time, s</source>
      <translation>tempo, s</translation>
    </message>
    <message>
      <source>triangles</source>
      <translation>triangoli</translation>
    </message>
    <message>
      <source>volume, mm3</source>
      <translation>volume, mm3</translation>
    </message>
    <message>
      <source>{designs}, about {time}</source>
      <translation>{designs}, circa {time}</translation>
    </message>
    <message>
      <source>{number} designs</source>
      <translation>{number} progetti</translation>
    </message>
  </context>
  <context>
    <name>VolfrepTaskPanel</name>
    <message>
      <source>'{text}' is no direction: write 100, 110, 111 or three numbers such as 1,2,0.</source>
      <translation>'{text}' non è una direzione: scrivere 100, 110, 111 o tre numeri come 1,2,0.</translation>
    </message>
    <message>
      <source>'{text}' is no value: type one such as 2 mm, a sum such as 2 mm + 1 mm, or = for a formula.</source>
      <translation>'{text}' non è un valore: scrivere per esempio 2 mm, una somma come 2 mm + 1 mm, o = per una formula.</translation>
    </message>
    <message>
      <source>Along faces</source>
      <translation>Lungo facce</translation>
    </message>
    <message>
      <source>Along the skin</source>
      <translation>Lungo il guscio</translation>
    </message>
    <message>
      <source>Cell that is laid in</source>
      <translation>Cella che viene inserita</translation>
    </message>
    <message>
      <source>Cells</source>
      <translation>Celle</translation>
    </message>
    <message>
      <source>Cells kept</source>
      <translation>Celle tenute</translation>
    </message>
    <message>
      <source>Clear</source>
      <translation>Svuota</translation>
    </message>
    <message>
      <source>Column of the field</source>
      <translation>Colonna del campo</translation>
    </message>
    <message>
      <source>Compute</source>
      <translation>Calcola</translation>
    </message>
    <message>
      <source>Cut the part open on the screen, along a plane that can be moved; once more shows it whole</source>
      <translation>Apre il pezzo sullo schermo lungo un piano che si può spostare; ancora una volta lo mostra intero</translation>
    </message>
    <message>
      <source>Diameter</source>
      <translation>Diametro</translation>
    </message>
    <message>
      <source>Distance</source>
      <translation>Distanza</translation>
    </message>
    <message>
      <source>Drain holes</source>
      <translation>Fori di scarico</translation>
    </message>
    <message>
      <source>Drain holes in faces</source>
      <translation>Fori di scarico nelle facce</translation>
    </message>
    <message>
      <source>Driven by</source>
      <translation>Guidato da</translation>
    </message>
    <message>
      <source>Evened out, times</source>
      <translation>Uniformato, volte</translation>
    </message>
    <message>
      <source>Faces to follow</source>
      <translation>Facce da seguire</translation>
    </message>
    <message>
      <source>File</source>
      <translation>File</translation>
    </message>
    <message>
      <source>Graph file</source>
      <translation>File di grafo</translation>
    </message>
    <message>
      <source>Height of layers</source>
      <translation>Altezza degli strati</translation>
    </message>
    <message>
      <source>Kind of lattice</source>
      <translation>Tipo di reticolo</translation>
    </message>
    <message>
      <source>Layers</source>
      <translation>Strati</translation>
    </message>
    <message>
      <source>Look for a file</source>
      <translation>Cerca un file</translation>
    </message>
    <message>
      <source>Make the mesh of these values now and stay in this panel</source>
      <translation>Crea ora la mesh di questi valori e resta in questo pannello</translation>
    </message>
    <message>
      <source>Material</source>
      <translation>Materiale</translation>
    </message>
    <message>
      <source>Networks</source>
      <translation>Reti</translation>
    </message>
    <message>
      <source>Of faces with a skin of their own: the thickness of those that are picked next; a face that has another gets it, one that has it goes back to the usual skin, and 0 leaves it open. Of drain holes: the diameter of all. Of what is kept solid: the distance from all its faces</source>
      <translation>Delle facce con guscio proprio: lo spessore di quelle che si scelgono dopo; una faccia con un altro lo riceve, una che lo ha torna al guscio solito, e 0 la lascia aperta. Dei fori di scarico: il diametro di tutti. Di ciò che resta pieno: la distanza da tutte le sue facce</translation>
    </message>
    <message>
      <source>On the other side</source>
      <translation>Sull'altro lato</translation>
    </message>
    <message>
      <source>Pick</source>
      <translation>Scegli</translation>
    </message>
    <message>
      <source>Points</source>
      <translation>Punti</translation>
    </message>
    <message>
      <source>Points and values</source>
      <translation>Punti e valori</translation>
    </message>
    <message>
      <source>Preview</source>
      <translation>Anteprima</translation>
    </message>
    <message>
      <source>Process</source>
      <translation>Processo</translation>
    </message>
    <message>
      <source>Section</source>
      <translation>Sezione</translation>
    </message>
    <message>
      <source>Seed</source>
      <translation>Seme</translation>
    </message>
    <message>
      <source>Sheet or skeleton</source>
      <translation>Foglio o scheletro</translation>
    </message>
    <message>
      <source>Sheet thickness</source>
      <translation>Spessore della parete</translation>
    </message>
    <message>
      <source>Shortest strut</source>
      <translation>Asta più corta</translation>
    </message>
    <message>
      <source>Shows the solid: click at a face, an edge, a vertex, an axis or a plane; once more ends it</source>
      <translation>Mostra il solido: fare clic su una faccia, uno spigolo, un vertice, un asse o un piano; ancora una volta per finire</translation>
    </message>
    <message>
      <source>Skin thickness</source>
      <translation>Spessore del guscio</translation>
    </message>
    <message>
      <source>TPMS</source>
      <translation>TPMS</translation>
    </message>
    <message>
      <source>Target relative density</source>
      <translation>Densità relativa voluta</translation>
    </message>
    <message>
      <source>Thickness</source>
      <translation>Spessore</translation>
    </message>
    <message>
      <source>Thickness at the end</source>
      <translation>Spessore alla fine</translation>
    </message>
    <message>
      <source>Thickness at the start</source>
      <translation>Spessore all'inizio</translation>
    </message>
    <message>
      <source>Thickness curve</source>
      <translation>Curva dello spessore</translation>
    </message>
    <message>
      <source>Thickness field</source>
      <translation>Campo dello spessore</translation>
    </message>
    <message>
      <source>Thickness formula</source>
      <translation>Formula dello spessore</translation>
    </message>
    <message>
      <source>Thickness grading</source>
      <translation>Gradazione dello spessore</translation>
    </message>
    <message>
      <source>Thickness profile</source>
      <translation>Profilo dello spessore</translation>
    </message>
    <message>
      <source>Thickness reach</source>
      <translation>Portata dello spessore</translation>
    </message>
    <message>
      <source>Thickness, diameter or distance</source>
      <translation>Spessore, diametro o distanza</translation>
    </message>
    <message>
      <source>To print</source>
      <translation>Per la stampa</translation>
    </message>
    <message>
      <source>Unit cells</source>
      <translation>Celle</translation>
    </message>
    <message>
      <source>What to pick</source>
      <translation>Che cosa scegliere</translation>
    </message>
    <message>
      <source>automatic</source>
      <translation>automatico</translation>
    </message>
    <message>
      <source>drag an end of the arrow in the view to turn it</source>
      <translation>trascinare un'estremità della freccia nella vista per ruotarla</translation>
    </message>
    <message>
      <source>nothing picked</source>
      <translation>niente di scelto</translation>
    </message>
  </context>
  <context>
    <name>VolfrepWorkbench</name>
    <message>
      <source>Fill a solid with a strut lattice, ready for the printer</source>
      <translation>Riempie un solido con un reticolo di aste, pronto per la stampante</translation>
    </message>
  </context>
  <context>
    <name>Workbench</name>
    <message>
      <source>Examples</source>
      <translation>Esempi</translation>
    </message>
  </context>
</TS>
